// The commands of texremap. Each has a file of its own.
#pragma once

#include <filesystem>

#include "command_line/command.hpp"

namespace remap {

// `--converters`, an option of every command; use_converters() takes its path.
Option* add_converters_option(Command& command, std::filesystem::path& path);

void add_convert_command(Command& app);
void add_list_command(Command& app);
void add_path_command(Command& app);

}  // namespace remap
