// texremap: converts texture maps from the parameters of one BRDF model to those of another.
#include <string>

#include "command_line/command.hpp"
#include "command_line/interruption.hpp"
#include "command_line/run_app.hpp"
#include "remap/version.hpp"
#include "texremap/commands.hpp"

int main(int argc, char** argv) {
  remap::watch_interruptions();
  remap::Command app("Convert texture maps from the parameters of one BRDF model to those of another.",
                     "texremap");
  app.set_version_flag("--version", std::string("texremap ") + remap::kVersion);
  app.require_subcommand(1);
  remap::add_convert_command(app);
  remap::add_check_command(app);
  remap::add_list_command(app);
  remap::add_path_command(app);
  remap::add_index_command(app);
  remap::add_plan_command(app);
  remap::add_merge_reports_command(app);
  app.footer(
      "Example:\n"
      "  texremap convert --from mitsuba/ward --to mitsuba/as \\\n"
      "    --roughness r.exr --specular s.exr -o out");
  return remap::run_app(app, argc, argv);
}
