// This file is `remapc sample`. It matches random materials of a model and writes a table of named
// parameters.
#include "commands/commands.hpp"
#include "commands/measurement.hpp"
#include "commands/option_readers.hpp"
#include "measure/sweep.hpp"

namespace remap {
namespace {

struct SampleCommand : MeasurementOptions {
  MaterialSampleOptions sample;  // its pair is set when the command runs
};

Range range_of(const ParameterSetting& setting) {
  if (setting.values.size() != 2 || !(setting.values[0] < setting.values[1]))
    setting.fail("not a range (write NAME=MIN,MAX with MIN below MAX)");
  return {setting.values[0], setting.values[1]};
}

void run(const SampleCommand& command) {
  MaterialSampleOptions options = command.sample;
  static_cast<PairOptions&>(options) = command.chosen_pair();
  Measurement measurement(command);
  const MaterialTable table =
      run_material_sample(measurement.renderer(), options, measurement.start("sample", options.count));
  measurement.write(material_table_text(table), table.comments);
  measurement.report(table.rows,
                     {{"source_columns", table.source_columns}, {"target_columns", table.target_columns}});
}

constexpr std::size_t kMostMaterials = 1'000'000;

void add_options(Command& app, SampleCommand& command) {
  MaterialSampleOptions& sample = command.sample;
  command.add_table_options(app, "CSV table to write, with a column per parameter and channel");
  app.option_group("Materials");
  app.add_option("--count", sample.count, "Number of random materials")
      ->range(std::size_t{1}, kMostMaterials);
  app.add_option("--seed", sample.seed, "Seed of the random materials");
  app.add_option(
         "--vary NAME", sample.varied,
         "Vary this parameter of the source in addition to roughness, specular and diffuse; may be repeated")
      ->allow_extra_args(false);
  add_settings<Range>(app, "--range NAME=MIN,MAX", sample.ranges, range_of,
                      "Range of a parameter of the source, in its own unit; may be repeated");
  app.add_option(
         "--search NAME", sample.searched,
         "Match this parameter of the target in addition to roughness, specular and diffuse; may be repeated")
      ->allow_extra_args(false);
  app.add_flag("--grey", sample.grey, "Use grey materials, with one value per color");
  command.add_picture_options(app);
  command.add_execution_options(app);
}

}  // namespace

void add_sample_command(Command& app) {
  Command* command = app.add_subcommand(
      "sample", "Match random materials of many parameters with the target model, and write the table",
      kMeasureStage);
  SampleCommand& options = set_work<SampleCommand>(*command, run);
  options.pair.resolution = 128;
  add_options(*command, options);
  command->footer(
      "Example:\n"
      "  remapc sample --source mitsuba/ggx-metallic --target mitsuba/ggx \\\n"
      "    --vary metallic --vary specular --count 1000 --seed 7 -o metallic_to_ggx.csv\n"
      "  remapc sample --source mitsuba/ggx --target mitsuba/ggx-metallic \\\n"
      "    --search metallic --grey -o ggx_to_metallic.csv");
}

}  // namespace remap
