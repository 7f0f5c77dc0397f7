// `remapc study`: reproductions and studies that write tables and plots and say in words what was found. Each
// study is a subcommand of its own.
#include "commands/commands.hpp"
#include "commands/studies.hpp"

namespace remapc {

void add_study_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "study", "Reproduce a figure of the paper or a figure of this project, as tables, plots and words");
  command->require_subcommand(1);
  add_environments_study(*command);
  add_workflows_study(*command);
  add_conductors_study(*command);
  add_dielectrics_study(*command);
  add_warp_study(*command);
}

}  // namespace remapc
