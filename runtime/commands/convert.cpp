// `texremap convert`: one texture set through one converter, or through a path of them. Checks everything
// that can be checked before the first texel is read.
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "command_line/run_app.hpp"
#include "commands/commands.hpp"
#include "commands/convert_options.hpp"
#include "commands/convert_report.hpp"
#include "commands/converter_text.hpp"
#include "convert/chained_converter.hpp"
#include "error.hpp"
#include "model/fit_json.hpp"
#include "texture/target_plan.hpp"
#include "version.hpp"

namespace remap {
namespace {

constexpr const char* kProgram = "texremap";

void require_agreement(const std::string& option, const std::string& asked, const std::string& file,
                       const std::string& found) {
  if (asked.empty() || asked == found) return;
  throw Error(ErrorKind::kUsage, file + ": is a fit of " + found + "; expected " + asked + " of " + option);
}

void warn(const ConvertOptions& options, const std::string& message) {
  if (!options.quiet) print_message(kProgram, "warning: " + message);
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

Metadata metadata_of(const ChosenConverter& chosen) {
  const ConverterInfo& info = chosen.converter->info();
  std::string ids;
  for (const Converter* step : chosen.path.steps) ids += (ids.empty() ? "" : " ") + step->info().id;
  return {{"remap:converter", ids},
          {"remap:source", info.source.model},
          {"remap:target", info.target.model},
          {"remap:version", kVersion}};
}

// A map that was converted already holds parameters of another model, unless that is the one to start from.
void require_not_converted(const TextureSet& set, const std::string& source, bool force) {
  if (force) return;
  for (const ImageReader& map : set.maps) {
    const std::optional<std::string> model = noted_metadata(map, "remap:target");
    if (model && *model != source)
      throw Error(ErrorKind::kUsage, map.path().string() + ": was converted to " + *model +
                                         " already; expected a map of " + source + ", or --force");
  }
}

void warn_of_doubts(const ConvertOptions& options, const TextureSet& set,
                    const std::vector<TargetMap>& targets) {
  if (options.color_space.empty())
    for (const std::string& remark : remarks(set)) warn(options, remark);
  for (const TargetMap& target : targets) {
    if (const std::string& lossy = target.writer.layout().lossy_compression; !lossy.empty())
      warn(options, target.writer.path().string() + ": " + lossy +
                        " compression changes values; --format png or exr keeps them");
  }
}

bool is_constant(const ParameterRequest& request) {
  return std::holds_alternative<ConstantValues>(request.source);
}

// Numbers alone: no map is read or written.
void convert_values(const ConvertOptions& options, const ChosenConverter& chosen,
                    const TextureSetRequest& request) {
  const PassOptions pass = pass_options(options);
  MapConversion maps;
  maps.width = maps.height = 1;
  const auto source = [](const ParameterRequest& parameter, const std::string& name) {
    SourceParameter result;
    result.constants = std::get<ConstantValues>(parameter.source);
    result.factors = parameter.factors;
    result.name = name;
    return result;
  };
  maps.roughness = source(request.roughness, "--roughness");
  maps.specular = source(request.specular, "--specular");
  maps.source_convention = request.convention;
  maps.target_convention = pass.target_convention;
  maps.bad_texels = pass.bad_texels;
  ConvertedValues values;
  values.specular.resize(maps.specular.constants.size());
  maps.roughness_out.channels = {float_channel(&values.roughness, 1)};
  for (float& value : values.specular) maps.specular_out.channels.push_back(float_channel(&value, 1));
  values.in_domain = convert_maps(*chosen.converter, maps).out_of_domain_count == 0;
  const ConverterInfo& info = chosen.converter->info();
  if (!values.in_domain) warn(options, "the values are outside " + domain_text(info));
  print_values(chosen, std::string(convention_name(pass.target_convention.value_or(info.target.roughness))),
               values, options.json);
}

void convert(const ConvertOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const ChosenConverter chosen = choose_converter(options);
  const ConverterInfo& info = chosen.converter->info();
  const TextureSetRequest request = set_request(options);
  if (is_constant(request.roughness) && is_constant(request.specular))
    return convert_values(options, chosen, request);
  if (options.output.empty())
    throw Error(ErrorKind::kUsage, "--output: is missing; expected a folder for the results");
  TargetChoice choice = target_choice(options);
  choice.metadata = metadata_of(chosen);
  PassOptions pass = pass_options(options);

  set_image_thread_count(pass.thread_count);
  TextureSet set = open_texture_set(request);
  require_not_converted(set, info.source.model, options.force);
  const std::vector<PlannedMap> planned = plan_targets(set, choice);
  std::vector<TargetMap> targets = open_targets(set, planned, choice);
  warn_of_doubts(options, set, targets);

  pass.cancelled = &interruption();
  Outcome outcome{chosen, set, targets, {}, 0.0};
  {
    Progress progress(info.id, static_cast<std::size_t>(set.height()), !options.quiet);
    pass.progress = [&](std::size_t rows) { progress.advance_to(rows); };
    outcome.statistics = run_texture_pass(set, targets, *chosen.converter, pass);
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!options.quiet) print_summary(kProgram, outcome);
  if (options.json) print_json(outcome);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = app.add_subcommand("convert", "Convert the roughness and specular maps of a material");
  add_convert_options(*command, *options);
  command->footer(
      "Results have the names of the inputs. A packed map keeps its other channels bit for bit. Two numbers\n"
      "instead of maps are converted and printed.\n\n"
      "Example:\n"
      "  texremap convert --from mitsuba/ward --to mitsuba/as --roughness r.exr --specular s.exr -o out\n"
      "  texremap convert --from mitsuba/ggx --to mitsuba/ward --roughness orm.png:G --roughness-encoding "
      "\\\n"
      "    roughness --specular 0.04 --only roughness -o out\n"
      "  texremap convert --from mitsuba/ward --to mitsuba/ggx --roughness 0.3 --specular 0.04");
  command->callback([options] { convert(*options); });
}

}  // namespace remap
