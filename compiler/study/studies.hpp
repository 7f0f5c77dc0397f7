// This file declares the subcommands of `remap-study`. Each function adds one study to the program.
#pragma once

#include "command_line/command.hpp"

namespace remap {

void add_environments_study(Command& study);
void add_reach_study(Command& study);
void add_workflows_study(Command& study);

}  // namespace remap
