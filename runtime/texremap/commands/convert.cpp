// This file is `texremap convert`, which converts texture sets, assets or numbers.
#include "texremap/commands/commands.hpp"
#include "texremap/plan/convert_plan.hpp"
#include "texremap/report/reporter.hpp"
#include "texremap/run/run_jobs.hpp"

namespace remap {

void convert(ConvertOptions options) {
  const ConvertPlan plan = resolve(std::move(options));
  if (plan.is_of_numbers()) return print_converted_numbers(plan);
  Reporter reporter(plan);
  const std::vector<JobReport> reports =
      run_jobs(plan, [&](const JobReport& report) { reporter.add(report); });
  if (!plan.report.empty()) write_report_page(plan, reports);
  reporter.finish(reports);
}

void add_convert_command(Command& app) {
  Command* command = app.add_subcommand(
      "convert", "Convert the maps of a material: roughness and specular, or a whole workflow");
  ConvertOptions& options = set_work<ConvertOptions>(*command, [command](ConvertOptions given) {
    note_given(*command, given);
    convert(std::move(given));
  });
  add_convert_options(*command, options);
  command->footer(
      "MAP is a file, FILE:CHANNEL or FILE:R,G,B of a packed file, or linear numbers (0.5 or 0.9,0.6,0.2). "
      "<UDIM>, %(UDIM)d, <UVTILE>, %04d and #### in a file name stand for all tiles or frames.\n\n"
      "Results keep the names of their inputs, and a packed map keeps its other channels bit for bit. "
      "If you give only numbers, texremap converts and prints them. With DIR, sets are found by the file "
      "names that Substance Painter, Poly Haven, ambientCG, Quixel Megascans, glTF exporters and Mari use. A "
      "set that fails does not stop the others; the exit code is then 1.\n\n"
      "Example:\n"
      "  texremap convert textures --from blender --to unity -o out\n"
      "  texremap convert model.glb -o converted.glb\n"
      "  texremap convert --from mitsuba/ward --to mitsuba/as \\\n"
      "    --roughness r.exr --specular s.exr -o out\n"
      "  texremap convert --from mitsuba/ggx --to mitsuba/ward --roughness orm.png:G \\\n"
      "    --roughness-encoding roughness --specular 0.04 --only roughness -o out\n"
      "  texremap convert assets --recursive --from mitsuba/ward --to mitsuba/ggx \\\n"
      "    --specular 0.04 -o converted\n"
      "  texremap convert --from mitsuba/ward --to mitsuba/ggx --roughness 0.3 \\\n"
      "    --specular 0.04\n"
      "  texremap convert --from gltf-specgloss --to gltf --diffuse d.png \\\n"
      "    --specular sg.png --glossiness sg.png:A --layout orm -o out\n"
      "  texremap convert model.obj --to gltf -o model.glb");
}

}  // namespace remap
