// `remapc sample` matches random materials of a model and writes a table of named parameters.
#include <chrono>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/command.hpp"
#include "command_line/interruption.hpp"
#include "commands/commands.hpp"
#include "commands/pair_selection.hpp"
#include "commands/parameter_setting.hpp"
#include "commands/renderer_options.hpp"
#include "commands/table_summary.hpp"
#include "remap/error.hpp"
#include "sweep/material_sample.hpp"
#include "system/files.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

struct SampleCommand {
  PairSelection pair;
  std::size_t count = 1000;
  std::uint64_t seed = 0;
  std::vector<std::string> varied, ranges, searched;
  bool grey = false;
  unsigned jobs = 0;
  bool force = false, json = false, quiet = false;
  std::filesystem::path output;
  RendererOptions renderers;
};

MaterialSampleOptions material_sample_options(const SampleCommand& command) {
  MaterialSampleOptions options;
  command.pair.fill(&options);
  options.count = command.count;
  options.seed = command.seed;
  options.grey = command.grey;
  options.varied = command.varied;
  options.searched = command.searched;
  for (const std::string& text : command.ranges) {
    const ParameterSetting setting = parse_setting("--range", text);
    if (setting.values.size() != 2 || !(setting.values[0] < setting.values[1]))
      throw Error(ErrorKind::kUsage,
                  "--range " + text + ": not a range (write NAME=MIN,MAX with MIN below MAX)");
    options.ranges[setting.name] = {setting.values[0], setting.values[1]};
  }
  return options;
}

void report(const SampleCommand& command, const MaterialTable& table, const PictureCount& pictures,
            double seconds) {
  TableSummary summary;
  for (const NamedRow& row : table.rows) summary.add(row.status, row.error);
  if (command.json) {
    nlohmann::ordered_json json = {{"table", command.output.string()},
                                   {"source_columns", table.source_columns},
                                   {"target_columns", table.target_columns}};
    summary.append_to(&json, pictures, seconds);
    std::cout << json.dump(2) << "\n";
  } else if (!command.quiet) {
    std::cerr << command.output.string() << ": " << summary.text(pictures, seconds) << "\n";
  }
}

void run(const SampleCommand& command) {
  const auto start = std::chrono::steady_clock::now();
  remap::watch_interruptions();
  const MaterialSampleOptions options = material_sample_options(command);
  if (!command.force && std::filesystem::exists(command.output))
    throw Error(ErrorKind::kOutput, command.output.string() + ": already exists (--force overwrites)");
  const auto renderer = make_renderers(command.renderers);
  MaterialTable table;
  {
    PictureProgress progress(renderer.get(), "sample " + options.source + " -> " + options.target,
                             options.count, !command.quiet);
    SweepExecution execution;
    execution.jobs = command.jobs;
    execution.progress = [&](std::size_t done, std::size_t) { progress.advance_to(done); };
    execution.cancelled = &remap::interruption();
    table = run_material_sample(*renderer, options, execution);
  }
  remap::write_file(command.output, material_table_text(table));
  for (const std::string& remark : renderer->remarks()) std::cerr << "remapc: " << remark << "\n";
  report(command, table, renderer->pictures(),
         std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

constexpr std::size_t kMostSamples = 1'000'000;

void add_options(remap::Command& app, SampleCommand& command) {
  command.pair.add_model_options(app);
  app.option_group("Output");
  app.add_option("-o,--output", command.output, "CSV table to write, with a column per parameter and channel")
      ->type_name("FILE")
      ->required();
  app.add_flag("--force", command.force, "Overwrite the table");
  app.add_flag("--json", command.json, "Print a summary as JSON to standard output");
  app.add_flag("--quiet", command.quiet, "Print no progress and no summary");
  app.option_group("Materials");
  app.add_option("--count", command.count, "Number of random materials")
      ->range(std::size_t{1}, kMostSamples)
      ->capture_default_str();
  app.add_option("--seed", command.seed, "Seed of the random materials")->capture_default_str();
  app.add_option("--vary", command.varied,
                 "Vary this parameter of the source in addition to roughness, specular and diffuse; may be "
                 "repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  app.add_option("--range", command.ranges,
                 "Range of a parameter of the source, in its own unit; may be repeated")
      ->type_name("NAME=MIN,MAX")
      ->allow_extra_args(false);
  app.add_option("--search", command.searched,
                 "Match this parameter of the target in addition to roughness, specular and diffuse; may be "
                 "repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  app.add_flag("--grey", command.grey, "Use grey materials, with one value per color");
  command.pair.add_picture_options(app);
  command.pair.add_rare_options(app);
  app.add_option("--jobs", command.jobs, "Threads, 0: one per core; the table does not depend on it")
      ->group(remap::kRareOptions)
      ->capture_default_str();
  add_renderer_options(app, command.renderers);
}

}  // namespace

void add_sample_command(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "sample", "Match random materials of many parameters with the target model, and write the table");
  command->group(kMeasureStage);
  auto options = std::make_shared<SampleCommand>();
  options->pair.resolution = 128;
  add_options(*command, *options);
  command->footer(
      "Example:\n"
      "  remapc sample --source mitsuba/ggx-metallic --target mitsuba/ggx \\\n"
      "    --vary metallic --vary specular --count 1000 --seed 7 -o metallic_to_ggx.csv\n"
      "  remapc sample --source mitsuba/ggx --target mitsuba/ggx-metallic \\\n"
      "    --search metallic --grey -o ggx_to_metallic.csv");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
