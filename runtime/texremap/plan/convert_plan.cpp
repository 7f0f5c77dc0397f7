#include "texremap/plan/convert_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assets/maps/gltf_maps.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "paths/converter_file.hpp"
#include "remap/path.hpp"
#include "remap/warp.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/plan/asset_formats.hpp"
#include "texremap/plan/conversion_request.hpp"
#include "texremap/plan/converter_text.hpp"
#include "texremap/plan/job.hpp"
#include "texremap/plan/workflow_choice.hpp"

namespace remap {
namespace {

// Takes the models from the fit, if --converters names one and --from or --to is missing.
void complete_models(const std::optional<FittedConverter>& fit, ConvertOptions& options) {
  const auto* data = fit ? std::get_if<ConverterData>(&*fit) : nullptr;
  if (data == nullptr || (!options.from.empty() && !options.to.empty())) return;
  const std::string file = options.converters.path().string();
  require_model_of_fit(file, "--from", options.from.name, data->info.source.model);
  require_model_of_fit(file, "--to", options.to.name, data->info.target.model);
  options.from.name = data->info.source.model;
  options.to.name = data->info.target.model;
}

BuiltConversion conversion_of(const ConvertOptions& options, const WarpMapFit* warp,
                              ConversionChoice choice) {
  if (warp != nullptr) {
    BuiltConversion conversion{std::move(choice)};
    conversion.material = make_warp_converter(*warp, *conversion.choice.source, options.instructions);
    return conversion;
  }
  if (options.from.empty() || options.to.empty())
    throw usage_error(std::string(options.from.empty() ? "--from" : "--to") +
                      " is required (texremap list shows the models)");
  return build_conversion(std::move(choice), options.via, options.converters.graph(options.instructions),
                          options.instructions);
}

bool are_constants(const TextureSetRequest& request) {
  return std::ranges::all_of(request.parameters, [](const auto& entry) {
    return std::holds_alternative<ConstantValues>(entry.second.source);
  });
}

// Refuses results inside the tree that a manifest lists, because the next index would list them.
void require_outside(const std::filesystem::path& output, const std::filesystem::path& tree) {
  std::error_code failure;
  const std::filesystem::path below =
      std::filesystem::weakly_canonical(output, failure)
          .lexically_relative(std::filesystem::weakly_canonical(tree, failure));
  if (!output.empty() && !below.empty() && *below.begin() != "..")
    throw usage_error("--output " + output.string() + ": is " +
                      (below == "." ? "" : "inside " + tree.string() + ", ") +
                      "the folder that the manifest lists (choose a folder outside " + tree.string() + ")");
}

// Returns a warning if roughness maps of a folder are read in an encoding that few tools write, or "".
std::string encoding_warning(const ConvertOptions& options, const JobList& list, const ModelSide& source) {
  if (options.folder.empty() || options.roughness_encoding ||
      source.roughness == RoughnessEncoding::kRoughness)
    return "";
  const bool matters = std::ranges::any_of(
      list.jobs, [](const Job& job) { return !std::get<SetWork>(job.work).request.convention; });
  if (!matters) return "";
  return "warning: roughness maps are read as " + std::string(encoding_name(source.roughness)) +
         ", the parameter of " + source.model +
         " (if the maps hold the square root of alpha, use --roughness-encoding roughness)";
}

// Reads the entries of this run from the manifest, if there is one. DIR becomes the root of the tree.
std::optional<TreeManifest> listed_entries(ConvertOptions& options) {
  if (options.manifest.empty()) return std::nullopt;
  if (!options.names.empty())
    throw usage_error("--names cannot be used with --manifest (give --names to texremap index instead)");
  TreeManifest manifest = read_manifest(options.manifest, options.part.value_or(Part()));
  if (options.folder.empty()) options.folder = manifest.head.root;
  std::error_code ignored;
  if (!std::filesystem::is_directory(options.folder, ignored))
    throw input_error(options.folder.string() + ": does not exist, but " + options.manifest.string() +
                      " lists files of this folder (if it was moved, give its new path as DIR)");
  require_outside(options.output, options.folder);
  return manifest;
}

// Returns values as numbers from 0 to 1. Treats a single value up to 100 as per cent, and other values as 0
// to 255.
std::string fractions_text(const std::vector<float>& values) {
  const bool is_percent = values.size() == 1 && values.front() <= 100.0f;
  return joined(values, ",", [&](double value) {
    return number_text(std::round(value / (is_percent ? 1.0 : 2.55)) / 100.0);
  });
}

// Refuses numbers that can only be per cent or 0 to 255, except exponents.
void require_fractions(const TextureSetRequest& request, const ConverterInfo& info) {
  const auto require = [](const std::string& option, const ParameterRequest& asked) {
    const auto* values = std::get_if<ConstantValues>(&asked.source);
    if (values == nullptr || std::ranges::none_of(*values, [](float value) { return value >= 2.0f; })) return;
    const std::string typed = joined(*values, ",", number_text);
    const bool has_meaning = std::ranges::all_of(*values, [](float value) { return value <= 255.0f; });
    const std::string sign = option.starts_with("--input ") ? "=" : " ";
    throw usage_error(option + sign + typed + ": values lie between 0 and 1" +
                      (has_meaning ? " (write " + option + sign + fractions_text(*values) + ")" : ""));
  };
  const RoughnessEncoding width = request.convention.value_or(info.source.roughness);
  for (const auto& [parameter, asked] : request.parameters) {
    const auto* numbers = std::get_if<ConstantValues>(&asked.source);
    if (numbers != nullptr && numbers->size() > 1 && !is_color(parameter))
      throw usage_error(parameter_option(parameter) + ": has three values (give one)");
    const bool is_exponent = parameter == Parameter::kRoughness && width == RoughnessEncoding::kExponent;
    const std::string name = plain_name(parameter);
    const bool is_fraction = name.ends_with("_weight") || name.ends_with("_roughness");
    const bool has_other_unit = is_input(parameter) && !is_fraction;  // an index of refraction, a length
    const bool is_wide = parameter == Parameter::kSpecular && info.specular.max > 1.0;
    if (!is_exponent && !is_wide && !has_other_unit)
      require(parameter == Parameter::kRoughness && width == RoughnessEncoding::kGlossiness
                  ? "--glossiness"
                  : parameter_option(parameter),
              asked);
  }
  for (const Carried<ParameterRequest>& carried : request.carried)
    require(parameter_option(*parameter_named(carried.name)), carried.parameter);
}

// Plans the conversion of numbers, or of texture sets.
void plan_sets(ConvertOptions& options, std::optional<TreeManifest> manifest, ConvertPlan& plan) {
  std::optional<Discovery> found;  // sets of the manifest or the folder; without either there are none
  choose_files(options);
  if (manifest) found = std::move(manifest->found);
  std::string inferred;
  const std::optional<FittedConverter> fit = options.converters.fit();
  const WarpMapFit* warp = fit ? std::get_if<WarpMapFit>(&*fit) : nullptr;
  complete_models(fit, options);
  if (options.from.empty() && warp == nullptr && !options.to.empty()) {
    if (options.part)
      throw usage_error(
          "--from is required with --part, because texremap cannot detect the model from the maps of one "
          "part");
    if (!found) found = discovered_sets(options);
    inferred = infer_source(options, found);
  }
  ConversionChoice workflow = warp != nullptr ? workflow_of_warp(options, *warp) : workflow_choice(options);
  if (!inferred.empty()) workflow.notes.insert(workflow.notes.begin(), inferred);
  TargetChoice targets = target_choice(options, workflow);
  TextureSetRequest request = set_request(options, workflow);
  SetPlan& sets = plan.work.emplace<SetPlan>(
      SetPlan{options.converters, conversion_of(options, warp, std::move(workflow)), std::move(request),
              std::move(targets), options.dielectric_f0, options.output_roughness.white.has_value()});
  const BuiltConversion& chosen = sets.chosen;
  const auto name = [](const ModelName& typed, const ModelSide& side) {
    return typed.alias != nullptr ? std::string(typed.word()) : side.model;
  };
  sets.source_name = name(options.from, chosen.info().source);
  sets.target_name = name(options.to, chosen.info().target);
  require_fractions(sets.request, chosen.info());
  for (const std::string& text : chosen.choice.assumptions) plan.messages.push_back("warning: " + text);
  for (const std::string& text : chosen.choice.notes) plan.messages.push_back("note: " + text);
  if (chosen.choice.is_closest) plan.messages.push_back("note: " + closest_text(chosen.choice.target_brdf));
  if (options.folder.empty() && are_constants(sets.request))
    return refuse(
        options, kNeedsFiles,
        ": has no effect, because you gave only numbers (give a map as a file, or remove this option)");
  if (!found) found = discovered_sets(options);
  if (options.output.empty()) throw usage_error("--output is required (add -o FOLDER)");
  plan.list = set_jobs(options, chosen.choice, sets.request, std::move(found));
  if (const std::string text = encoding_warning(options, plan.list, chosen.info().source); !text.empty())
    plan.messages.push_back(text);
  for (const std::string& text : plan.list.notes) plan.messages.push_back("note: " + text);
  plan.conversion = conversion_note(chosen.info().source.model, chosen.info().target.model,
                                    converter_ids(chosen), chosen.converter(), result_options_text(options));
}

// Refuses layouts of engines for assets: textures stay in their asset, so it cannot become a folder of maps.
void refuse_engine(const ConvertOptions& options) {
  if (engine_layout_of(options.to.word()) == nullptr) return;
  throw usage_error(
      "--to " + std::string(options.to.word()) + ": texremap does not extract textures from assets such as " +
      display_path(options.folder) +
      " (use --to gltf, which engines import, or export the textures and convert their folder)");
}

// Fills in missing options. Without --to, assets become gltf. Without --output, the second path is the
// result.
void complete_asset_options(ConvertOptions& options) {
  const bool is_gltf = options.to.empty() || options.to.name == "metallic";
  if (engine_layout_of(options.to.word()) == nullptr && is_gltf)
    options.to = model_name().read("--to", "gltf");
  const bool is_tree = options.assets || !options.manifest.empty();
  if (!is_tree && options.asset_root.empty() && options.output.empty() && options.more_assets.size() == 1)
    options.output = std::exchange(options.more_assets, {}).front();
}

void require_asset_options(const ConvertOptions& options) {
  refuse_engine(options);
  const bool is_tree = options.assets || !options.manifest.empty();
  for (const GivenOption& option : options.given)
    if ((option.tags & (kNeedsAsset | kForAssets)) == 0)
      throw usage_error(option.name + ": has no effect, because " + display_path(options.folder) +
                        (is_tree ? " is converted as a folder of assets" : " is an asset") +
                        " (remove this option)");
  if (!is_tree)
    refuse(options, kNeedsTree,
           ": applies only to folders of assets (remove this option, or give a folder and --assets)");
  if (is_tree && !options.more_assets.empty())
    throw usage_error(std::string(options.assets ? "--assets" : "--manifest") +
                      ": converts one folder, but " + display_path(options.more_assets.front()) +
                      " is given, too (give only one folder)");
  const bool is_core_source = options.from.name == "gltf" && options.to.name == "gltf-specgloss";
  if (!options.from.empty() && options.from.name != "gltf-specgloss" && !is_core_source &&
      !mtl_maker_of(options))
    throw usage_error(
        "--from " + options.from.name +
        ": texremap reads the material model from the file (remove this option; for MTL files, use " +
        joined(names_of(kMtlMakers), ", ") + ")");
  if (options.to.name != "gltf" && options.to.name != "gltf-specgloss")
    throw usage_error("--to " + options.to.name +
                      ": the materials of an asset can become gltf or gltf-specgloss (use --to gltf)");
  refuse_diffuse(options, "glTF and MTL files define what diffuse means (");
  if (options.output.empty()) throw usage_error("--output is required (add -o FOLDER)");
  if (options.to.name != "gltf" && options.extensions != DielectricExtensions::kKept)
    throw usage_error("--extensions: applies to --to gltf only (remove this option)");
}

const std::string kOnlyGltf = ": applies only if the input is a glTF file";

void require_no_jpeg(const ConvertOptions& options) {
  if (options.compression.jpeg_quality)
    throw usage_error("--compression jpeg" + kOnlyGltf + " (remove jpeg=QUALITY)");
}

// Refuses options that no asset of the run uses.
void require_gltf(const ConvertOptions& options, const JobList& list) {
  const auto is_gltf = [](const Job& job) { return is_gltf_name(std::get<AssetWork>(job.work).input); };
  if (mtl_maker_of(options) && std::ranges::all_of(list.jobs, is_gltf))
    throw usage_error("--from " + std::string(options.from.word()) +
                      ": applies to MTL and OBJ files only (remove this option)");
  if (std::ranges::any_of(list.jobs, is_gltf)) return;
  refuse(options, kNeedsGltf, kOnlyGltf + " (remove this option)");
  if (options.extensions == DielectricExtensions::kFolded)
    throw usage_error("--extensions fold" + kOnlyGltf + " (remove this option)");
  require_no_jpeg(options);
  if (options.to.name != "gltf")
    throw usage_error("--to " + options.to.name +
                      ": materials of MTL and OBJ files can only become gltf (use --to gltf)");
}

AssetOptions asset_options(const ConvertOptions& options) {
  AssetOptions asset{options.extensions, options.prior, options.instructions, options.resample};
  asset.target = options.to.name == "gltf-specgloss" ? AssetTarget::kSpecGloss : AssetTarget::kMetalRough;
  asset.mtl_maker = mtl_maker_of(options);
  asset.compacts = !options.keep_unused;
  asset.jpeg_quality = options.compression.jpeg_quality;
  asset.png_level = options.compression.level;
  return asset;
}

void plan_assets(const ConvertOptions& options, const std::optional<TreeManifest>& manifest,
                 ConvertPlan& plan) {
  require_asset_options(options);
  plan.list = asset_jobs(options, manifest ? &*manifest : nullptr);
  require_gltf(options, plan.list);
  plan.work = asset_options(options);
  plan.conversion =
      conversion_note("assets", options.to.name, "",
                      *asset_converter("gltf-specgloss", "gltf", options.prior, options.instructions),
                      result_options_text(options));
}

// Returns true if the run converts assets. Otherwise refuses options of assets.
bool are_assets(const ConvertOptions& options, const std::optional<TreeManifest>& manifest) {
  if (manifest ? manifest->head.kind == ListedKind::kAssets : options.assets || is_asset(options.folder))
    return true;
  require_no_jpeg(options);
  refuse(options, kNeedsAsset,
         ": applies only to assets (remove this option, give a glTF, MTL or OBJ file, or add --assets)");
  return false;
}

// Returns a command line as a shell reads it.
std::string command_text(const std::vector<GivenOption>& given) {
  std::string text = "texremap convert";
  for (const GivenOption& option : given) {
    if (option.name.starts_with("-")) text += " " + option.name;
    for (const std::string& word : option.words) text += " " + shell_word(word);
  }
  return text;
}

// Makes the first path the root of the assets behind it, if it is a folder.
void take_root(ConvertOptions& options) {
  std::vector<std::filesystem::path>& assets = options.more_assets;
  std::error_code ignored;
  if (options.assets || !options.manifest.empty() || assets.empty() ||
      !std::ranges::all_of(assets, is_asset) || !std::filesystem::is_directory(options.folder, ignored))
    return;
  options.asset_root = std::exchange(options.folder, assets.front());
  assets.erase(assets.begin());
}

// Confines inputs to the folders in which others may have put files.
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

ConvertPlan resolve(ConvertOptions options) {
  take_root(options);
  if (!options.assets) require_one_kind(options.folder, options.more_assets);
  std::optional<TreeManifest> manifest = listed_entries(options);
  const bool has_assets = are_assets(options, manifest);
  ConvertPlan plan;
  if (options.part && !options.part->note.empty()) plan.messages.push_back("note: " + options.part->note);
  if (manifest) plan.manifest = manifest->head;
  if (has_assets) complete_asset_options(options);
  confine(options, manifest);
  if (has_assets)
    plan_assets(options, manifest, plan);
  else
    plan_sets(options, std::move(manifest), plan);
  static_cast<RunOptions&>(plan) = options;
  plan.command = command_text(options.given);
  if (!plan.report.empty()) require_new(plan.report, plan.force);
  plan.threads = options.threads();
  plan.memory_bytes = options.memory_bytes();
  return plan;
}

}  // namespace remap
