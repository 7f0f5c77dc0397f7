// `texremap convert`: one texture set through one converter, or through a path of them. Checks everything
// that can be checked before the first texel is read.
#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "command_line/run_app.hpp"
#include "commands/commands.hpp"
#include "commands/converter_text.hpp"
#include "commands/output_paths.hpp"
#include "convert/chained_converter.hpp"
#include "convert/path.hpp"
#include "error.hpp"
#include "model/fit_json.hpp"
#include "nearest_name.hpp"
#include "texture/texture_pass.hpp"
#include "version.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr const char* kProgram = "texremap";

struct ConvertOptions {
  std::string from;
  std::string to;
  std::vector<std::string> via;
  std::string fit;
  std::string roughness;
  std::string specular;
  std::string output;
  std::string roughness_channel;
  std::string format;
  std::string type;
  std::string instructions;
  int thread_count = 0;
  bool force = false;
  bool json = false;
  bool quiet = false;
};

// A converter that is compiled in, or one that was made for this run: of a fit, or of the steps of a path.
struct ChosenConverter {
  std::unique_ptr<Converter> owned;
  const Converter* converter = nullptr;
  ConverterPath path;
};

void require_agreement(const std::string& option, const std::string& asked, const std::string& file,
                       const std::string& found) {
  if (asked.empty() || asked == found) return;
  throw Error(ErrorKind::kUsage, file + ": is a fit of " + found + "; expected " + asked + " of " + option);
}

void warn(const ConvertOptions& options, const std::string& message) {
  if (!options.quiet) print_message(kProgram, "warning: " + message);
}

InstructionSet chosen_instructions(const ConvertOptions& options) {
  if (options.instructions.empty()) return best_instruction_set();
  return instruction_set_from_name("--instructions", options.instructions);
}

// A fit that cannot be lowered is still converted: as it is, slowly.
std::unique_ptr<Converter> converter_of_fit(const ConvertOptions& options, InstructionSet set) {
  Fit fit = load_fit(options.fit);
  require_agreement("--from", options.from, options.fit, fit.source.model);
  require_agreement("--to", options.to, options.fit, fit.target.model);
  try {
    return make_lowered_converter(fit, set);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kNumeric) throw;
    warn(options, options.fit + ": is evaluated by the interpreter, which is slow; " + error.what());
  }
  return make_interpreted_converter(std::move(fit));
}

ChosenConverter choose_converter(const ConvertOptions& options) {
  ChosenConverter chosen;
  const InstructionSet set = chosen_instructions(options);
  if (!options.fit.empty()) {
    chosen.owned = converter_of_fit(options, set);
    chosen.path = {{chosen.owned.get()}, expected_error(chosen.owned->info())};
  } else {
    if (options.from.empty() || options.to.empty())
      throw Error(ErrorKind::kUsage, std::string(options.from.empty() ? "--from" : "--to") +
                                         ": is missing; expected --from and --to, or --fit");
    chosen.path = compiled_graph(set).find_paths({options.from, options.to, options.via}).front();
    if (chosen.path.steps.size() > 1) chosen.owned = make_chained_converter(chosen.path.steps);
  }
  chosen.converter = chosen.owned ? chosen.owned.get() : chosen.path.steps.front();
  if (!chosen.converter->self_test())
    throw Error(ErrorKind::kNumeric,
                chosen.converter->info().id + ": fails its self-test; expected the values it was made with");
  return chosen;
}

std::optional<PixelType> chosen_type(const std::string& name) {
  if (name.empty()) return std::nullopt;
  static const std::array<std::string, 4> kNames = {"uint8", "uint16", "half", "float"};
  if (std::find(kNames.begin(), kNames.end(), name) == kNames.end())
    throw Error(ErrorKind::kUsage, "--type: is " + name + suggestion(name, kNames));
  return pixel_type_from_name(name);
}

TextureSetRequest set_request(const ConvertOptions& options) {
  TextureSetRequest request{options.roughness, specular_source(options.specular), std::nullopt};
  if (!options.roughness_channel.empty()) request.roughness_channel = options.roughness_channel;
  return request;
}

ImageChanges changes_for(const ConvertOptions& options, const ChosenConverter& chosen) {
  const ConverterInfo& info = chosen.converter->info();
  std::string ids;
  for (const Converter* step : chosen.path.steps) ids += (ids.empty() ? "" : " ") + step->info().id;
  ImageChanges changes;
  changes.type = chosen_type(options.type);
  changes.metadata = {{"remap:converter", ids},
                      {"remap:source", info.source.model},
                      {"remap:target", info.target.model},
                      {"remap:version", kVersion}};
  return changes;
}

TargetMaps open_targets(const OutputPaths& paths, const TextureSet& set, ImageChanges changes) {
  ImageWriter roughness(paths.roughness, set.roughness.reader, changes);
  if (const auto* map = std::get_if<SourceMap>(&set.specular))
    return {std::move(roughness), ImageWriter(paths.specular, map->reader, changes)};
  changes.channels = set.specular_channel_count() == 1 ? std::vector<std::string>{"Y"}
                                                       : std::vector<std::string>{"R", "G", "B"};
  return {std::move(roughness), ImageWriter(paths.specular, set.roughness.reader, changes)};
}

void warn_of_doubts(const ConvertOptions& options, const TextureSet& set, const TargetMaps& target) {
  for (const std::string& doubt : doubts(set)) warn(options, doubt);
  for (const ImageWriter* writer : {&target.roughness, &target.specular}) {
    if (const std::string& lossy = writer->layout().lossy_compression; !lossy.empty())
      warn(options, writer->path().string() + ": " + lossy +
                        " compression changes values; --format png or exr keeps them");
  }
}

int thread_count(const ConvertOptions& options) {
  if (options.thread_count > 0) return options.thread_count;
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

struct Outcome {
  const ChosenConverter& chosen;
  const TargetMaps& target;
  PassStatistics statistics;
  double seconds = 0.0;
};

// The id of one converter; the models of a path.
std::string converter_text(const ChosenConverter& chosen) {
  if (chosen.path.steps.size() == 1) return chosen.converter->info().id;
  return models_text(chosen.path) + " (expected error " + expected_text(chosen.path.expected_error) + ")";
}

// What texels were outside of.
std::string outside_text(const ChosenConverter& chosen) {
  const std::string domain = domain_text(chosen.converter->info());
  if (chosen.path.steps.size() == 1) return domain;
  return "what one of the steps covers (the path: " + domain + ")";
}

void print_summary(const Outcome& outcome) {
  const PassStatistics& counts = outcome.statistics;
  const auto line = [](std::size_t count, const std::string& what) {
    if (count > 0) print_message(kProgram, std::to_string(count) + what);
  };
  std::array<char, 32> seconds;
  std::snprintf(seconds.data(), seconds.size(), "%.2f", outcome.seconds);
  line(counts.texel_count,
       " texels in " + std::string(seconds.data()) + " s by " + converter_text(outcome.chosen) + ": " +
           outcome.target.roughness.path().string() + ", " + outcome.target.specular.path().string());
  line(counts.out_of_domain_count, " texels outside " + outside_text(outcome.chosen) +
                                       ": width clamped, specular extrapolated in proportion");
  line(counts.nan_count, " texels with NaN: kept as NaN where the pixel type can hold it");
  line(counts.infinite_count, " texels with infinite values");
  line(counts.negative_count, " texels with negative values");
  line(counts.clipped_count, " values clipped to [0, 1] by an integer pixel type");
}

void print_json(const Outcome& outcome) {
  const ConverterInfo& info = outcome.chosen.converter->info();
  const PassStatistics& counts = outcome.statistics;
  const Json result = {{"converter", info.id},
                       {"path", path_json(outcome.chosen.path)},
                       {"expected_error", outcome.chosen.path.expected_error},
                       {"source", info.source.model},
                       {"target", info.target.model},
                       {"roughness", outcome.target.roughness.path().string()},
                       {"specular", outcome.target.specular.path().string()},
                       {"texels", counts.texel_count},
                       {"out_of_domain", counts.out_of_domain_count},
                       {"nan", counts.nan_count},
                       {"infinite", counts.infinite_count},
                       {"negative", counts.negative_count},
                       {"clipped_values", counts.clipped_count},
                       {"instructions", std::string(instruction_set_name(info.instructions))},
                       {"seconds", outcome.seconds}};
  // File names need not be UTF-8.
  std::cout << result.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void convert(const ConvertOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const ChosenConverter chosen = choose_converter(options);
  const ConverterInfo& info = chosen.converter->info();
  const TextureSetRequest request = set_request(options);
  const ImageChanges changes = changes_for(options, chosen);
  const OutputPaths paths = output_paths(request, {options.output, options.format, options.force});

  set_image_thread_count(thread_count(options));
  TextureSet set = open_texture_set(request);
  create_output_folder(options.output);
  TargetMaps target = open_targets(paths, set, changes);
  warn_of_doubts(options, set, target);

  PassOptions pass;
  pass.thread_count = thread_count(options);
  pass.cancelled = &interruption();
  Outcome outcome{chosen, target, {}, 0.0};
  {
    Progress progress(info.id, static_cast<std::size_t>(set.height()), !options.quiet);
    pass.progress = [&](std::size_t rows) { progress.advance_to(rows); };
    outcome.statistics = run_texture_pass(set, target, *chosen.converter, pass);
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!options.quiet) print_summary(outcome);
  if (options.json) print_json(outcome);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = app.add_subcommand("convert", "Convert a roughness map and a specular map");
  command->add_option("--from", options->from, "Source model, e.g. mitsuba/ward");
  command->add_option("--to", options->to, "Target model, e.g. mitsuba/as");
  CLI::Option* via =
      command
          ->add_option("--via", options->via,
                       "Model that the path must go through; give it again for more, in their order")
          ->allow_extra_args(false);
  command->add_option("--fit", options->fit, "Lower this fit (JSON) instead of taking compiled converters")
      ->excludes(via);
  command->add_option("--roughness", options->roughness, "Roughness map of the source model")->required();
  command
      ->add_option("--specular", options->specular,
                   "Specular map, or a linear constant: 0.5, or 0.9,0.6,0.2 for red, green, blue")
      ->required();
  command->add_option("-o,--output", options->output, "Folder of the results; their names are the inputs'")
      ->required();
  command->add_option("--roughness-channel", options->roughness_channel,
                      "Channel of the roughness map to convert; the others pass through");
  command->add_option("--format", options->format, "Extension of the results: exr, tif, png, ...");
  command->add_option("--type", options->type, "Pixel type of the results: uint8, uint16, half, float");
  command->add_option("--threads", options->thread_count, "Threads; 0, the default, is one a core")
      ->check(CLI::Range(0, 1024));
  command->add_option("--instructions", options->instructions,
                      "baseline, avx2 or avx512; the default is the widest of this processor. The results "
                      "are the same");
  command->add_flag("--force", options->force, "Replace results that exist (never an input)");
  command->add_flag("--json", options->json, "Machine-readable result on standard output");
  command->add_flag("--quiet", options->quiet, "Nothing on standard error but failures");
  command->footer(
      "Example:\n  texremap convert --from mitsuba/ward --to mitsuba/as --roughness r.exr --specular s.exr "
      "-o out");
  command->callback([options] { convert(*options); });
}

}  // namespace remap
