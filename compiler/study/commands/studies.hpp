// The studies of `remapc study`: each adds itself as a subcommand of it.
#pragma once

#include <CLI/CLI.hpp>

namespace remapc {

void add_environments_study(CLI::App& study);
void add_workflows_study(CLI::App& study);
void add_conductors_study(CLI::App& study);
void add_dielectrics_study(CLI::App& study);
void add_warp_study(CLI::App& study);

}  // namespace remapc
