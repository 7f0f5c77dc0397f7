// The commands of texremap. Each has a file of its own.
#pragma once

#include "command_line/command.hpp"

namespace remap {

inline constexpr const char* kProgram = "texremap";  // begins every message

void add_check_command(Command& app);
void add_convert_command(Command& app);
void add_index_command(Command& app);
void add_list_command(Command& app);
void add_merge_reports_command(Command& app);
void add_path_command(Command& app);
void add_plan_command(Command& app);

}  // namespace remap
