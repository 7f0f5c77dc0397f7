// `remapc sweep` matches a grid of materials of two models and writes a table.
#include "sweep/sweep.hpp"

#include <chrono>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/command.hpp"
#include "command_line/interruption.hpp"
#include "commands/commands.hpp"
#include "commands/pair_selection.hpp"
#include "commands/renderer_options.hpp"
#include "commands/table_summary.hpp"
#include "remap/error.hpp"
#include "sweep/provenance.hpp"
#include "system/files.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;
using remap::number_text;

struct SweepCommand {
  PairSelection pair;
  std::size_t roughness_samples = 30, specular_samples = 30;
  std::vector<double> roughness_range = {0.01, 1.0}, specular_range;
  std::string samples_of, columns;
  int stages = 2;
  double diffuse = 0.0;
  unsigned jobs = 0;
  bool force = false, json = false, quiet = false;
  std::filesystem::path output;
  RendererOptions renderers;
};

remap::Range parse_range(const std::string& option, const std::vector<double>& values) {
  if (values.size() != 2 || !(values[0] <= values[1]))
    throw Error(ErrorKind::kUsage, option + ": not a range (write MIN,MAX with MIN not above MAX)");
  return {values[0], values[1]};
}

void choose_samples(const SweepCommand& command, const Renderer& renderer, SweepOptions* options) {
  if (!command.samples_of.empty()) {
    const Table table =
        read_table(command.samples_of, command.columns.empty() ? ColumnMap{} : column_map(command.columns));
    for (const TableRow& row : table.rows) options->samples.push_back({row.alpha1, row.specular1});
    options->sampling = std::to_string(table.rows.size()) + " of " +
                        std::filesystem::path(command.samples_of).filename().string();
    return;
  }
  const remap::Range alphas = parse_range("--roughness-range", command.roughness_range);
  const remap::Range speculars =
      command.specular_range.empty()
          ? canonical_speculars(renderer, recast(renderer.model(options->source), options->source_roles))
          : parse_range("--specular-range", command.specular_range);
  options->samples = grid_samples(alphas, command.roughness_samples, speculars, command.specular_samples);
  options->sampling = grid_text(alphas, command.roughness_samples, speculars, command.specular_samples);
}

SweepOptions sweep_options(const SweepCommand& command, const Renderer& renderer) {
  SweepOptions options;
  command.pair.fill(&options);
  options.stages = command.stages;
  options.diffuse = command.diffuse;
  choose_samples(command, renderer, &options);
  return options;
}

void require_free_output(const SweepCommand& command) {
  if (!command.force && std::filesystem::exists(command.output))
    throw Error(ErrorKind::kOutput, command.output.string() + ": already exists (--force overwrites)");
}

void warn_of_subpixel(const Table& table, const SweepOptions& options) {
  const double limit = subpixel_alpha(options.resolution, options.samples_per_axis);
  std::size_t rows = 0;
  for (const TableRow& row : table.rows) rows += row.alpha1 < limit ? 1 : 0;
  if (rows != 0)
    std::cerr << "remapc: warning: " << rows << " rows have alpha1 below "
              << number_text(remap::rounded_up(limit, 2))
              << ", where the highlight is smaller than a pixel (increase --resolution or --pixel-samples)\n";
}

void report(const SweepCommand& command, const Table& table, const PictureCount& pictures, double seconds) {
  TableSummary summary;
  for (const TableRow& row : table.rows) summary.add(row.status, row.error);
  if (command.json) {
    nlohmann::ordered_json json = {{"table", command.output.string()}};
    summary.append_to(&json, pictures, seconds);
    std::cout << json.dump(2) << "\n";
  } else if (!command.quiet) {
    std::cerr << command.output.string() << ": " << summary.text(pictures, seconds) << "\n";
  }
}

void run(const SweepCommand& command) {
  const auto start = std::chrono::steady_clock::now();
  remap::watch_interruptions();
  const auto renderer = make_renderers(command.renderers);
  const SweepOptions options = sweep_options(command, *renderer);
  require_free_output(command);
  remap::create_parent(command.output);

  Table table;
  {
    PictureProgress progress(renderer.get(), "sweep " + options.source + " -> " + options.target,
                             options.samples.size(), !command.quiet);
    SweepExecution execution;
    execution.jobs = command.jobs;
    execution.progress = [&](std::size_t done, std::size_t) { progress.advance_to(done); };
    execution.cancelled = &remap::interruption();
    table = run_sweep(*renderer, options, execution);
  }
  remap::write_file(command.output, table_text(table));
  warn_of_subpixel(table, options);
  for (const std::string& remark : renderer->remarks()) std::cerr << "remapc: " << remark << "\n";
  report(command, table, renderer->pictures(),
         std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

constexpr int kMostSamples = 4096;  // of each axis

void add_sample_options(remap::Command& app, SweepCommand& command) {
  app.option_group("Samples");
  app.add_option("--roughness-samples", command.roughness_samples, "Number of source alphas")
      ->range(1, kMostSamples)
      ->capture_default_str();
  app.add_option("--specular-samples", command.specular_samples, "Number of source speculars for each alpha")
      ->range(1, kMostSamples)
      ->capture_default_str();
  app.add_option("--roughness-range", command.roughness_range, "Range of the source's alpha")
      ->type_name("MIN,MAX")
      ->delimiter(',')
      ->expected(1, 2)
      ->capture_default_str();
  app.add_option("--specular-range", command.specular_range,
                 "Range of the source's specular, F0 for an index (default: the model's range)")
      ->type_name("MIN,MAX")
      ->delimiter(',')
      ->expected(1, 2);
  app.add_option("--diffuse", command.diffuse, "Diffuse reflectance of the source in every sample")
      ->capture_default_str();
  app.add_option("--samples-of", command.samples_of, "Use the samples of this table instead of a grid")
      ->type_name("FILE");
}

void add_options(remap::Command& app, SweepCommand& command) {
  command.pair.add_model_options(app);
  app.option_group("Output");
  app.add_option("-o,--output", command.output, "CSV table to write")->type_name("FILE")->required();
  app.add_flag("--force", command.force, "Overwrite the table");
  app.add_flag("--json", command.json, "Print a summary as JSON to standard output");
  app.add_flag("--quiet", command.quiet, "Print no progress and no summary");
  add_sample_options(app, command);
  command.pair.add_picture_options(app);
  command.pair.add_rare_options(app);
  app.option_group(remap::kRareOptions);
  app.add_option("--columns", command.columns,
                 "Names of columns in the table of --samples-of: sztrajman-2019, or OWN=FILE,...")
      ->type_name("MAP");
  app.add_option(
         "--stages", command.stages,
         "2: match diffuse, then specular; 1: all at once from a fixed start; 3: all at once from the "
         "result of 2")
      ->range(1, 3)
      ->capture_default_str();
  app.add_option("--jobs", command.jobs, "Threads, 0: one per core; the table does not depend on it")
      ->capture_default_str();
  add_renderer_options(app, command.renderers);
}

}  // namespace

void add_sweep_command(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "sweep", "Match a grid of source materials with the target model, and write the table");
  command->group(kMeasureStage);
  auto options = std::make_shared<SweepCommand>();
  add_options(*command, *options);
  command->footer(
      "Example:\n"
      "  remapc sweep --source mitsuba/ward --target mitsuba/as -o ward_to_as.csv\n"
      "  remapc sweep --source radiance/plastic --target mitsuba3/ggx \\\n"
      "    --resolution 256 -o radiance_to_ggx.csv\n"
      "  remapc sweep --source mitsuba/ggx-metallic --source-set metallic=0.5 \\\n"
      "    --target mitsuba/ggx -o half_metal.csv");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
