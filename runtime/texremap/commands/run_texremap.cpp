#include "command_line/command.hpp"
#include "command_line/run_app.hpp"
#include "texremap/commands/commands.hpp"

namespace remap {

int run_texremap(int argc, const char* const* argv) noexcept {
  Command app("Convert textures and materials so that they look the same in another renderer.", "texremap");
  app.set_version_flag("--version", version_text("texremap"));
  app.require_subcommand(1);
  add_convert_command(app);
  add_check_command(app);
  add_list_command(app);
  add_path_command(app);
  add_index_command(app);
  add_plan_command(app);
  add_merge_reports_command(app);
  for (const char* name : {"mtlx", "usd"})
    app.retire_command(
        name, "is a command of the Python package (pip install '.[images,usd,materialx]' in the clone)");
  app.footer(
      "Example:\n"
      "  texremap convert --from mitsuba/ward --to mitsuba/as \\\n"
      "    --roughness r.exr --specular s.exr -o out");
  return run_app(app, argc, argv);
}

}  // namespace remap
