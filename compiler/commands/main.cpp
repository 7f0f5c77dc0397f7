// This is remapc. It compiles two BRDF models into a C++ header that converts the parameters of one model
// into the parameters of the other.
#include "command_line/command.hpp"
#include "command_line/run_app.hpp"
#include "commands/commands.hpp"

int main(int argc, char** argv) {
  remap::Command app(
      "Measures how the parameters of one BRDF model convert to the parameters of another, and compiles the "
      "result into a C++ header: sweep, check, fit, emit.",
      "remapc");
  app.set_version_flag("--version", remap::version_text("remapc", REMAP_LIBRARIES));
  app.require_subcommand(1);
  remap::add_sweep_command(app);
  remap::add_sample_command(app);
  remap::add_render_command(app);
  remap::add_check_command(app);
  remap::add_export_command(app);
  remap::add_fit_command(app);
  remap::add_compare_command(app);
  remap::add_emit_command(app);
  remap::add_chain_command(app);
  remap::add_invert_command(app);
  remap::add_build_command(app);
  remap::add_list_command(app);
  remap::add_show_command(app);
  remap::add_preview_command(app);
  remap::add_eval_command(app);
  remap::add_renderers_command(app);
  remap::add_warp_command(app);
  app.footer(
      "Example:\n"
      "  remapc sweep --source mitsuba/ward --target mitsuba/as -o ward_to_as.csv\n"
      "  remapc fit ward_to_as.csv -o fits\n"
      "  remapc emit fits/mitsuba_ward_to_mitsuba_as.json -o generated");
  return remap::run_app(app, argc, argv);
}
