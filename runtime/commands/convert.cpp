// `texremap convert`: texture sets through one converter, or through a path of them. Checks everything that
// can be checked before the first texel is read.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "command_line/run_app.hpp"
#include "commands/commands.hpp"
#include "commands/convert_options.hpp"
#include "commands/convert_report.hpp"
#include "commands/converter_text.hpp"
#include "commands/job_run.hpp"
#include "convert/chained_converter.hpp"
#include "error.hpp"
#include "model/fit_json.hpp"

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

// What a folder's roughness maps are taken for, where that is not what most tools write.
void warn_of_encoding(const ConvertOptions& options, const JobList& list, const ModelSide& source) {
  if (options.folder.empty() || !options.encoding.empty() ||
      source.roughness == RoughnessConvention::kRoughness)
    return;
  const bool matters = std::any_of(list.jobs.begin(), list.jobs.end(),
                                   [](const ConversionJob& job) { return !job.request.convention; });
  if (matters)
    warn(options, "roughness maps are read as " + std::string(convention_name(source.roughness)) + ", as " +
                      source.model +
                      " has it; --roughness-encoding roughness where they hold its square root");
}

void convert_maps_of(const ConvertOptions& options, const ChosenConverter& chosen,
                     const TextureSetRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  if (options.output.empty())
    throw Error(ErrorKind::kUsage, "--output: is missing; expected a folder for the results");
  const JobList list = conversion_jobs(options, request);
  warn_of_encoding(options, list, chosen.converter->info().source);
  Outcome outcome{chosen, list, run_jobs(list, chosen, options), options.dry_run, 0.0, {}};
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.used = resource_use();
  if (!list.is_tree) outcome.reports.front().seconds = outcome.seconds;
  if (!options.quiet) {
    for (const JobReport& report : outcome.reports) print_job(kProgram, outcome, report);
    print_summary(kProgram, outcome);
  }
  if (options.json) print_json(outcome);
  if (const std::size_t failed = outcome.failed_count(); failed > 0)
    throw Error(ErrorKind::kInput, std::to_string(failed) + " of " +
                                       std::to_string(outcome.reports.size() + list.left_out.size()) +
                                       " sets failed; expected none");
}

void convert(const ConvertOptions& options) {
  (void)pass_options(options);  // wrong words before anything is looked at
  (void)target_choice(options);
  const TextureSetRequest request = set_request(options);
  const ChosenConverter chosen = choose_converter(options);
  if (options.folder.empty() && is_constant(request.roughness) && is_constant(request.specular))
    convert_values(options, chosen, request);
  else
    convert_maps_of(options, chosen, request);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = app.add_subcommand("convert", "Convert the roughness and specular maps of a material");
  add_convert_options(*command, *options);
  command->footer(
      "Results have the names of the inputs. A packed map keeps its other channels bit for bit. <UDIM>, "
      "%(UDIM)d,\n"
      "<UVTILE>, %04d and #### in the names of maps stand for all tiles or frames. Two numbers instead of "
      "maps are\n"
      "converted and printed. With DIR, every set whose maps are named as Substance Painter, Poly Haven,\n"
      "ambientCG, Quixel Megascans, glTF exporters or Mari name them is converted; one that fails does not "
      "stop\n"
      "the others, and makes the exit code 1.\n\n"
      "Example:\n"
      "  texremap convert --from mitsuba/ward --to mitsuba/as --roughness r.exr --specular s.exr -o out\n"
      "  texremap convert --from mitsuba/ggx --to mitsuba/ward --roughness orm.png:G --roughness-encoding "
      "\\\n"
      "    roughness --specular 0.04 --only roughness -o out\n"
      "  texremap convert assets --recursive --from mitsuba/ward --to mitsuba/ggx --specular 0.04 -o "
      "converted\n"
      "  texremap convert --from mitsuba/ward --to mitsuba/ggx --roughness 0.3 --specular 0.04");
  command->callback([options] { convert(*options); });
}

}  // namespace remap
