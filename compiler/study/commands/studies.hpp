// The subcommands of `remap-study`. Each function adds one study to the program.
#pragma once

#include "command_line/command.hpp"

namespace remapc {

void add_environments_study(remap::Command& study);
void add_reach_study(remap::Command& study);
void add_workflows_study(remap::Command& study);

}  // namespace remapc
