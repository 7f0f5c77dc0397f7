// This file declares the commands of texremap. Each is in a separate file.
#pragma once

#include "command_line/command.hpp"
#include "texremap/options/convert_options.hpp"

namespace remap {

// Runs the program: run_app() with all of its commands. It may be called more than once in a process, but
// only by one thread at a time.
int run_texremap(int argc, const char* const* argv) noexcept;

// Converts what the options name, and prints the results. Throws afterwards if a set or an asset failed.
void convert(ConvertOptions options);

void add_check_command(Command& app);
void add_convert_command(Command& app);
void add_index_command(Command& app);
void add_list_command(Command& app);
void add_merge_reports_command(Command& app);
void add_path_command(Command& app);
void add_plan_command(Command& app);

}  // namespace remap
