// This file is `remapc sweep`, which matches a grid of materials of two models and writes a table.
#include "measure/sweep.hpp"

#include <iostream>
#include <optional>

#include "commands/commands.hpp"
#include "commands/measurement.hpp"
#include "commands/option_readers.hpp"
#include "core/number_text.hpp"
#include "measure/sweep_options.hpp"

namespace remap {
namespace {

struct SweepCommand : MeasurementOptions {
  SweepOptions sweep;  // its pair and samples are set when the command runs
  std::size_t roughness_samples = 30, specular_samples = 30;
  Range roughness_range{0.01, 1.0};
  std::optional<Range> specular_range;  // if missing, the model's range
  TableInput samples_of;                // a table whose samples are used; if it has no path, a grid is used
};

void choose_samples(const SweepCommand& command, const Renderer& renderer, SweepOptions* options) {
  if (!command.samples_of.path.empty()) {
    const Table table = command.samples_of.read();
    for (const TableRow& row : table.rows) options->samples.push_back({row.alpha1, row.specular1});
    options->sampling = std::to_string(table.rows.size()) + " of " +
                        std::filesystem::path(command.samples_of.path).filename().string();
    return;
  }
  const Range alphas = command.roughness_range;
  const Range speculars =
      command.specular_range
          ? *command.specular_range
          : canonical_speculars(renderer, recast(renderer.model(options->source), options->source_roles));
  options->samples = grid_samples(alphas, command.roughness_samples, speculars, command.specular_samples);
  options->sampling = grid_text(alphas, command.roughness_samples, speculars, command.specular_samples);
}

void warn_of_subpixel(const Table& table, const SweepOptions& options) {
  const double limit = subpixel_alpha(options.resolution, options.samples_per_axis);
  std::size_t rows = 0;
  for (const TableRow& row : table.rows) rows += row.alpha1 < limit ? 1 : 0;
  if (rows != 0)
    std::cerr << "remapc: warning: " << counted(rows, "row") << (rows == 1 ? " has" : " have")
              << " alpha1 below " << number_text(rounded_up(limit, 2))
              << ", where the highlight is smaller than a pixel (increase --resolution or --pixel-samples)\n";
}

void run(const SweepCommand& command) {
  Measurement measurement(command);
  SweepOptions options = command.sweep;
  static_cast<PairOptions&>(options) = command.chosen_pair();
  choose_samples(command, measurement.renderer(), &options);
  const Table table =
      run_sweep(measurement.renderer(), options, measurement.start("sweep", options.samples.size()));
  measurement.write(table_text(table), table.comments);
  warn_of_subpixel(table, options);
  measurement.report(table.rows);
}

constexpr int kMostAxisSamples = 4096;  // limit for each axis

void add_sample_options(Command& app, SweepCommand& command) {
  app.option_group("Samples");
  app.add_option("--roughness-samples", command.roughness_samples, "Number of source alphas")
      ->range(1, kMostAxisSamples);
  app.add_option("--specular-samples", command.specular_samples, "Number of source speculars for each alpha")
      ->range(1, kMostAxisSamples);
  app.add_option("--roughness-range MIN,MAX", command.roughness_range, number_range(),
                 "Range of the source's alpha")
      ->default_text("0.01,1");
  app.add_option("--specular-range MIN,MAX", command.specular_range, number_range(),
                 "Range of the source's specular, or of its F0 if the model has an index of refraction "
                 "(default: the model's range)");
  app.add_option("--diffuse", command.sweep.diffuse, "Diffuse reflectance of the source in every sample");
  app.add_option("--samples-of FILE", command.samples_of.path,
                 "Use the samples of this table instead of a grid");
}

void add_options(Command& app, SweepCommand& command) {
  command.add_table_options(app, "CSV table to write");
  add_sample_options(app, command);
  command.add_picture_options(app);
  app.option_group(kRareOptions);
  app.add_option("--columns MAP", command.samples_of.columns, columns_reader(),
                 "Names of the columns in the table of --samples-of, as OWN=FILE,...");
  app.add_option("--stages", command.sweep.stages,
                 "2: match diffuse, then specular; 1: all at once from a fixed start; 3: all at once from "
                 "the result of 2")
      ->range(1, 3);
  command.add_execution_options(app);
}

}  // namespace

void add_sweep_command(Command& app) {
  Command* command = app.add_subcommand(
      "sweep", "Match a grid of source materials with the target model, and write the table", kMeasureStage);
  SweepCommand& options = set_work<SweepCommand>(*command, run);
  add_options(*command, options);
  command->footer(
      "Example:\n"
      "  remapc sweep --source mitsuba/ward --target mitsuba/as -o ward_to_as.csv\n"
      "  remapc sweep --source radiance/plastic --target mitsuba3/ggx \\\n"
      "    --resolution 256 -o radiance_to_ggx.csv\n"
      "  remapc sweep --source mitsuba/ggx-metallic --source-set metallic=0.5 \\\n"
      "    --target mitsuba/ggx -o half_metal.csv");
}

}  // namespace remap
