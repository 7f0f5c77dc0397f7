// The subcommands of `remap-study`. Each function adds one study to the program.
#pragma once

#include <CLI/CLI.hpp>

namespace remapc {

void add_environments_study(CLI::App& study);
void add_workflows_study(CLI::App& study);
void add_conductors_study(CLI::App& study);
void add_dielectrics_study(CLI::App& study);
void add_warp_study(CLI::App& study);

}  // namespace remapc
