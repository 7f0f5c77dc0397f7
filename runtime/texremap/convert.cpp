// `texremap convert`: converts texture sets by one converter or by a path of converters. It checks everything
// that can be checked before it reads the first texel.
#include "texremap/convert.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/run_app.hpp"
#include "convert/converter_file.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "core/stopwatch.hpp"
#include "remap/path.hpp"
#include "remap/warp.hpp"
#include "stages/brdf_stage.hpp"
#include "texremap/asset_jobs.hpp"
#include "texremap/commands.hpp"
#include "texremap/conversion_hash.hpp"
#include "texremap/conversion_request.hpp"
#include "texremap/convert_assets.hpp"
#include "texremap/convert_options.hpp"
#include "texremap/convert_report.hpp"
#include "texremap/converter_text.hpp"
#include "texremap/job_run.hpp"
#include "texremap/manifest.hpp"
#include "texremap/named_paths.hpp"
#include "texremap/part_report.hpp"
#include "texremap/set_choice.hpp"
#include "texremap/workflow_choice.hpp"

namespace remap {
namespace {

void warn(const ConvertOptions& options, const std::string& message) {
  if (!options.quiet) print_message(kProgram, "warning: " + message);
}

void note(const ConvertOptions& options, const std::string& message) {
  if (!options.quiet && !message.empty()) print_message(kProgram, "note: " + message);
}

std::unique_ptr<Converter> converter_of_fit(const ConvertOptions& options, const WorkflowChoice& workflow,
                                            const FittedConverter& fit, InstructionSet set) {
  const auto* data = std::get_if<ConverterData>(&fit);
  if (data == nullptr)
    throw Error(ErrorKind::kInput, options.fit +
                                       ": converts whole materials between workflows, which --from and --to "
                                       "name without a fit (remove --fit)");
  require_models_of_fit(options.fit, {workflow.source_brdf, workflow.target_brdf},
                        {data->info.source.model, data->info.target.model});
  return make_converter(*data, set);
}

// The fit that --fit names; none without that option.
using GivenFit = std::optional<FittedConverter>;

const WarpMapFit* warp_in(const GivenFit& fit) { return fit ? std::get_if<WarpMapFit>(&*fit) : nullptr; }

BuiltConversion conversion_of(const ConvertOptions& options, const GivenFit& fit,
                              const WorkflowChoice& workflow) {
  if (const WarpMapFit* warp = warp_in(fit)) {
    BuiltConversion conversion;
    conversion.material = make_warp_converter(*warp, *workflow.source, options.instructions);
    return conversion;
  }
  if (fit) return build_conversion(workflow, converter_of_fit(options, workflow, *fit, options.instructions));
  if (options.from.empty() || options.to.empty())
    throw usage_error(std::string(options.from.empty() ? "--from" : "--to") + " is required (or --fit)");
  return build_conversion(workflow, options.via, options.converters.graph(options.instructions),
                          options.instructions);
}

bool are_constants(const TextureSetRequest& request) {
  return std::all_of(request.parameters.begin(), request.parameters.end(), [](const auto& entry) {
    return std::holds_alternative<ConstantValues>(entry.second.source);
  });
}

// The name of a target parameter; the roughness is called by its encoding.
std::string name_of_target(const ChosenConverter& chosen, Parameter parameter, RoughnessConvention width) {
  if (parameter == Parameter::kRoughness) return std::string(convention_name(width));
  if (!chosen.workflow.is_material()) return chosen.info().target.specular;
  return std::string(parameter_name(parameter));
}

// Converts numbers; no map is read or written.
void convert_values(const ConvertOptions& options, const ChosenConverter& chosen,
                    const TextureSetRequest& request) {
  const PassOptions pass = pass_options(options);
  const ConverterInfo& info = chosen.info();
  MapConversion maps;
  maps.width = maps.height = 1;
  for (const auto& [parameter, asked] : request.parameters) {
    SourceParameter& source = maps.sources[parameter];
    source.constants = std::get<ConstantValues>(asked.source);
    source.factors = asked.factors;
    source.name = parameter_option(parameter);
  }
  maps.source_convention = request.convention;
  maps.target_convention = pass.target_convention;
  maps.target_roughness_factor = pass.target_roughness_factor;
  if (!maps.target_convention && chosen.workflow.is_material())
    maps.target_convention = width_of(*chosen.workflow.target);
  maps.bad_texels = pass.bad_texels;
  const RoughnessConvention width = maps.target_convention.value_or(info.target.roughness);
  require_factor_of_exponent(options, width);
  const auto specular = maps.sources.find(Parameter::kSpecular);
  ConvertedValues values;
  for (const Parameter parameter : chosen.converter().targets()) {
    if (parameter == Parameter::kDoubts) continue;
    const std::size_t channels = chosen.converter().target_channels(
        parameter, specular == maps.sources.end() ? 3 : specular->second.constants.size());
    values.values.push_back(
        {name_of_target(chosen, parameter, width), std::vector<float>(channels), !is_color(parameter)});
    for (float& value : values.values.back().channels)
      maps.targets[parameter].channels.push_back(float_channel(&value, 1));
  }
  values.in_domain = convert_maps(chosen.converter(), maps).out_of_domain_count == 0;
  if (!values.in_domain)
    warn(options, "the values are outside the domain (" + domain_text(chosen.domain()) + ")");
  note(options, note_text(chosen.path, chosen.closer));
  print_values(chosen, values, options.json);
}

// Refuses results inside of the tree that a manifest lists: the next index would list them.
void require_outside(const std::filesystem::path& output, const std::filesystem::path& tree) {
  std::error_code failure;
  const std::filesystem::path below =
      std::filesystem::weakly_canonical(output, failure)
          .lexically_relative(std::filesystem::weakly_canonical(tree, failure));
  if (!output.empty() && !below.empty() && *below.begin() != "..")
    throw usage_error("--output " + output.string() + ": lies in " + tree.string() +
                      ", the tree of the manifest (choose a folder outside of it)");
}

// Warns if roughness maps of a folder are read in another encoding than most tools write.
void warn_of_encoding(const ConvertOptions& options, const JobList& list, const ModelSide& source) {
  if (options.folder.empty() || options.roughness_encoding ||
      source.roughness == RoughnessConvention::kRoughness)
    return;
  const bool matters = std::any_of(list.jobs.begin(), list.jobs.end(),
                                   [](const ConversionJob& job) { return !job.request.convention; });
  if (matters)
    warn(options, "roughness maps are read as " + std::string(convention_name(source.roughness)) +
                      ", the parameter of " + source.model +
                      " (use --roughness-encoding roughness if they hold its square root)");
}

// What the manifest lists for this run; none without one. DIR becomes the root of the tree.
std::optional<TreeManifest> listed_entries(ConvertOptions& options) {
  if (options.manifest.empty()) return std::nullopt;
  if (!options.names.empty())
    throw usage_error("--names cannot be used with --manifest (give it to texremap index)");
  const Part all;
  TreeManifest manifest = read_manifest(options.manifest, options.part ? options.part->part : all);
  if (options.folder.empty()) options.folder = manifest.head.root;
  std::error_code ignored;
  if (!std::filesystem::is_directory(options.folder, ignored))
    throw input_error(options.folder.string() + ": no such folder, which " + options.manifest.string() +
                      " is of (give DIR, where the tree lies now)");
  require_outside(options.output, options.folder);
  if (options.part && !options.part->note.empty() && !options.quiet)
    print_message(kProgram, "note: " + options.part->note);
  return manifest;
}

// Per cent of one value, 0 to 255 of a color: the number from 0 to 1 that is meant.
std::string fractions_text(const std::vector<float>& values) {
  const bool is_percent = values.size() == 1 && values.front() <= 100.0f;
  std::string text;
  for (const float value : values)
    text += (text.empty() ? "" : ",") +
            number_text(std::round(static_cast<double>(value) / (is_percent ? 1.0 : 2.55)) / 100.0);
  return text;
}

// Refuses numbers that can only be per cent or 0 to 255, except exponents.
void require_fractions(const TextureSetRequest& request, const ConverterInfo& info) {
  const auto require = [](const std::string& option, const ParameterRequest& asked) {
    const auto* values = std::get_if<ConstantValues>(&asked.source);
    if (values == nullptr || std::ranges::none_of(*values, [](float value) { return value >= 2.0f; })) return;
    std::string typed;
    for (const float value : *values)
      typed += (typed.empty() ? "" : ",") + number_text(static_cast<double>(value));
    const bool has_meaning = std::ranges::all_of(*values, [](float value) { return value <= 255.0f; });
    throw usage_error(option + " " + typed + ": values lie between 0 and 1" +
                      (has_meaning ? " (write " + option + " " + fractions_text(*values) + ")" : ""));
  };
  const RoughnessConvention width = request.convention.value_or(info.source.roughness);
  for (const auto& [parameter, asked] : request.parameters) {
    const bool is_exponent = parameter == Parameter::kRoughness && width == RoughnessConvention::kExponent;
    const bool is_wide = parameter == Parameter::kSpecular && info.specular.max > 1.0;
    if (!is_exponent && !is_wide)
      require(parameter == Parameter::kRoughness && width == RoughnessConvention::kGlossiness
                  ? "--glossiness"
                  : parameter_option(parameter),
              asked);
  }
  for (const CarriedRequest& carried : request.carried) require("--" + carried.name, carried.parameter);
}

// A conversion that is checked as far as it can be before the first texel is read.
struct CheckedConversion {
  std::optional<Discovery> sets;  // of a manifest, or where the maps had to tell the source
  ManifestHead manifest;
  TextureSetRequest request;
  ChosenConverter chosen;
};

CheckedConversion checked(ConvertOptions& options, std::optional<TreeManifest> manifest) {
  CheckedConversion conversion;
  apply_preset(options);
  if (manifest) {
    conversion.manifest = manifest->head;
    conversion.sets = std::move(manifest->listing.found);
  }
  std::string told;
  if (options.from.empty() && options.fit.empty() && !options.to.empty()) {
    if (options.part)
      throw usage_error("--from is required (a part does not know the maps of the other parts)");
    if (!conversion.sets) conversion.sets = discovered_sets(options);
    const ToldSource source = told_source(options, conversion.sets);
    options.from = model_name().read("--from", source.model);
    told = source.note;
  }
  const GivenFit fit = options.fit.empty() ? std::nullopt : GivenFit(load_fitted_converter(options.fit));
  const WarpMapFit* warp = warp_in(fit);
  WorkflowChoice workflow = warp != nullptr ? workflow_of_warp(options, *warp) : workflow_choice(options);
  if (!told.empty()) workflow.notes.insert(workflow.notes.begin(), told);
  (void)target_choice(options, workflow);  // refuses what cannot be written before any file is read
  conversion.request = set_request(options, workflow);
  conversion.chosen = {conversion_of(options, fit, workflow), std::move(workflow)};
  require_fractions(conversion.request, conversion.chosen.info());
  for (const std::string& assumption : conversion.chosen.workflow.assumptions) warn(options, assumption);
  for (const std::string& meaning : conversion.chosen.workflow.notes) note(options, meaning);
  if (conversion.chosen.workflow.is_closest)
    note(options, closest_text(conversion.chosen.workflow.target_brdf));
  return conversion;
}

void convert_maps_of(const ConvertOptions& options, CheckedConversion conversion) {
  const ChosenConverter& chosen = conversion.chosen;
  const Stopwatch stopwatch;
  if (options.output.empty()) throw Error(ErrorKind::kUsage, "--output is required");
  const JobList list =
      conversion_jobs(options, chosen.workflow, conversion.request, std::move(conversion.sets));
  warn_of_encoding(options, list, chosen.info().source);
  Outcome outcome{chosen, list, {}, options.dry_run, options.histograms, options.json, 0.0, {}};
  Told told;
  told.failures_only = options.quiet;
  told.verbose = options.verbose;
  RunLines lines(options);
  const auto tell = [&](const Json& line) {
    if (list.is_tree) lines.tell(line);
  };
  if (!options.quiet)
    for (const std::string& note : list.notes) print_message(kProgram, "note: " + note);
  print_left_out(kProgram, list, options.quiet);
  if (options.part) tell(part_json(*options.part, conversion.manifest, conversion_note(chosen, options)));
  tell_start(outcome, tell);
  outcome.reports = run_jobs(list, chosen, options, [&](const JobReport& report) {
    if (list.is_tree) print_job(kProgram, outcome, report, told);
    tell_set(outcome, report, tell);
  });
  outcome.seconds = stopwatch.seconds();
  outcome.used = resource_use();
  if (!list.is_tree) outcome.reports.front().seconds = outcome.seconds;
  note(options, note_text(chosen.path, chosen.closer));
  if (!options.quiet) {
    if (!list.is_tree) print_job(kProgram, outcome, outcome.reports.front(), told);
    print_colors(kProgram, outcome);
    print_summary(kProgram, outcome, told);
  }
  if (list.is_tree)
    tell_end(outcome, tell);
  else if (options.json)
    print_json(outcome);
  lines.finish();
  const std::size_t all = outcome.reports.size() + list.left_out.size();
  const std::string of_all = " of " + std::to_string(all) + (all == 1 ? " set " : " sets ");
  if (const std::size_t failed = outcome.failed_count(); failed > 0)
    throw Error(ErrorKind::kInput, std::to_string(failed) + of_all + "failed", outcome.passing_failure());
  if (!list.left_out.empty() && !options.allow_skips)
    throw Error(ErrorKind::kInput,
                std::to_string(list.left_out.size()) + of_all +
                    "skipped, because there is nothing to convert in them (--allow-skips accepts "
                    "this)");
}

// Below what folders others may have put what the run reads.
void confine(const ConvertOptions& options, const std::optional<TreeManifest>& manifest) {
  std::vector<std::filesystem::path> folders;
  if (options.folder.empty() || options.follow_links) return confine_inputs({});
  if (manifest || !is_asset(options.folder))
    folders.push_back(options.folder);
  else if (!options.asset_root.empty())
    folders.push_back(options.asset_root);
  else
    for (const std::filesystem::path& asset : named_assets(options))
      folders.push_back(folder_of_asset(asset));
  confine_inputs(folders);
}

}  // namespace

void convert(ConvertOptions options) {
  if (!options.assets) require_one_kind(options.folder, options.more_assets);
  std::optional<TreeManifest> manifest = listed_entries(options);
  if (!manifest && is_asset(options.folder)) options = meaning_assets(std::move(options));
  confine(options, manifest);
  if (are_assets(options, manifest)) return convert_assets(options, manifest);
  CheckedConversion conversion = checked(options, std::move(manifest));
  if (options.folder.empty() && are_constants(conversion.request)) {
    refuse(options, kNeedsFiles,
           ": applies to nothing, because all maps are numbers (give a file, or remove this option)");
    convert_values(options, conversion.chosen, conversion.request);
  } else {
    if (!conversion.sets) conversion.sets = discovered_sets(options);
    convert_maps_of(options, std::move(conversion));
  }
}

void check_conversion(ConvertOptions options) {
  std::optional<TreeManifest> manifest = listed_entries(options);
  if (are_assets(options, manifest)) return check_assets(options, manifest);
  CheckedConversion conversion = checked(options, std::move(manifest));
  const JobList list =
      conversion_jobs(options, conversion.chosen.workflow, conversion.request, std::move(conversion.sets));
  warn_of_encoding(options, list, conversion.chosen.info().source);
}

void add_convert_command(Command& app) {
  Command* command = app.add_subcommand(
      "convert", "Convert the maps of a material: roughness and specular, or a whole workflow");
  ConvertOptions& options = set_work<ConvertOptions>(*command, [command](ConvertOptions given) {
    given.given = command->given();
    convert(given);
  });
  add_convert_options(*command, options);
  command->footer(
      "MAP is a file, FILE:CHANNEL or FILE:R,G,B of a packed file, or linear numbers (0.5 or 0.9,0.6,0.2). "
      "<UDIM>, %(UDIM)d, <UVTILE>, %04d and #### in a file name stand for all tiles or frames.\n\n"
      "Results keep the names of their inputs, and a packed map keeps its other channels bit for bit. "
      "Numbers "
      "in place of all maps are converted and printed. With DIR, sets are found by the file names that "
      "Substance Painter, Poly Haven, ambientCG, Quixel Megascans, glTF exporters and Mari use. A set that "
      "fails does not stop the others; the exit code is then 1.\n\n"
      "Example:\n"
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
      "  texremap convert model.glb --to gltf -o converted.glb\n"
      "  texremap convert model.obj --to gltf -o model.glb");
}

}  // namespace remap
