// This is remap-study. It measures the accuracy of converters, under environment maps and between workflows.
#include "command_line/command.hpp"
#include "command_line/run_app.hpp"
#include "study/study_options.hpp"

int main(int argc, char** argv) {
  remap::Command app(
      "Measure the accuracy of the converters. Each study prints its comparisons as CSV, from which "
      "scripts/studies/summarize makes tables and plots.",
      "remap-study");
  app.set_version_flag("--version", remap::version_text("remap-study", REMAP_LIBRARIES));
  app.require_subcommand(1);
  remap::add_environments_study(app);
  remap::add_reach_study(app);
  remap::add_workflows_study(app);
  return remap::run_app(app, argc, argv);
}
