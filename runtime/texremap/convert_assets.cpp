#include "texremap/convert_assets.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <utility>

#include "command_line/run_app.hpp"
#include "core/errors.hpp"
#include "core/stopwatch.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/asset_formats.hpp"
#include "texremap/asset_jobs.hpp"
#include "texremap/asset_report.hpp"
#include "texremap/asset_run.hpp"
#include "texremap/commands.hpp"
#include "texremap/part_report.hpp"

namespace remap {
namespace {

// The options of `texremap convert` that apply to assets, besides those with the tag kNeedsAsset.
constexpr std::array<std::string_view, 20> kAssetOptions = {
    "DIR",        "--from",      "--to",          "--prior",        "--output",
    "--force",    "--dry-run",   "--json",        "--quiet",        "--instructions",
    "--resample", "--recursive", "--resume",      "--threads",      "--format",
    "--manifest", "--part",      "--compression", "--follow-links", "--memory-limit"};
// Of these, those that apply to folders alone.
constexpr std::array<std::string_view, 2> kTreeOptions = {"--recursive", "--resume"};

bool holds(const auto& names, std::string_view name) { return std::ranges::find(names, name) != names.end(); }

// Textures stay in their asset: what an engine reads of a folder of maps cannot be made of it.
void refuse_engine(const ConvertOptions& options) {
  const Preset* preset = options.preset != nullptr ? options.preset : preset_of(options.to.word());
  if (preset == nullptr) return;
  throw usage_error(
      (options.preset != nullptr ? "--preset " + std::string(preset->name)
                                 : "--to " + std::string(options.to.word())) +
      ": textures are not taken out of assets such as " + shown(options.folder) +
      " (convert it by --to gltf, which engines import; or export its textures, as with Blender, "
      "and convert their folder by --preset " +
      std::string(preset->name) + ")");
}

void require_asset_options(const ConvertOptions& options) {
  refuse_engine(options);
  const bool is_tree = options.assets || !options.manifest.empty();
  for (const GivenOption& option : options.given) {
    if ((option.tags & kNeedsAsset) == 0 && !holds(kAssetOptions, option.name))
      throw usage_error(option.name + ": applies to nothing, because " + shown(options.folder) +
                        (is_tree ? " is converted as a folder of assets" : " is an asset") +
                        " (remove this option)");
    if (!is_tree && holds(kTreeOptions, option.name))
      throw usage_error(option.name +
                        ": applies to folders of assets alone (remove this option, or name a "
                        "folder and --assets)");
  }
  if (is_tree && (!options.more_assets.empty() || !options.asset_root.empty()))
    throw usage_error(std::string(options.assets ? "--assets" : "--manifest") + ": cannot be used with " +
                      (options.more_assets.empty()
                           ? std::string("--root, which is DIR")
                           : shown(options.more_assets.front()) + " (name one folder)"));
  const bool is_core_source = options.from.name == "gltf" && options.to.name == "gltf-specgloss";
  if (!options.from.empty() && options.from.name != "gltf-specgloss" && !is_core_source)
    throw usage_error("--from " + options.from.name +
                      ": the file tells what its materials are (remove this option)");
  if (options.to.name != "gltf" && options.to.name != "gltf-specgloss")
    throw usage_error("--to " + options.to.name +
                      ": materials of assets become gltf or gltf-specgloss (use --to gltf)");
  if (options.output.empty()) throw usage_error("--output is required");
  const bool is_core = options.to.name == "gltf" && options.profile == MaterialProfile::kCore;
  if (options.fold_specular && !is_core)
    throw usage_error("--fold-specular: applies to --to gltf with --profile core alone (remove one)");
  if (options.to.name != "gltf" && options.is_given("--profile"))
    throw usage_error("--profile: applies to --to gltf alone (remove this option)");
}

// Refuses options of which no asset of the run makes use.
void require_gltf(const ConvertOptions& options, const AssetList& list) {
  if (std::ranges::any_of(list.jobs, [](const AssetJob& job) { return is_gltf_name(job.input); })) return;
  for (const char* name : {"--fold-specular", "--keep-unused", "--bake", "--jpeg"})
    if (options.is_given(name))
      throw usage_error(std::string(name) + ": applies to glTF files alone (remove this option)");
  if (options.to.name != "gltf")
    throw usage_error("--to " + options.to.name + ": materials of MTL and OBJ files become gltf");
}

// Throws where an asset or some of its materials failed.
void require_success(const std::vector<AssetReport>& reports, const AssetSummary& summary) {
  if (summary.failed == 0 && summary.problems.empty()) return;
  int passing = 0;  // the code of a failure that may pass
  for (const AssetReport& report : reports)
    if (passes_later(report.failure_code)) passing = report.failure_code;
  if (reports.size() > 1 || summary.failed == 0)
    throw Error(
        ErrorKind::kInput,
        summary.failed > 0
            ? std::to_string(summary.failed) + " of " + std::to_string(summary.asset_count) + " assets failed"
            : std::to_string(summary.problems.size()) + " files or folders cannot be read",
        passing);
  const AssetReport& report = reports.front();
  if (!report.failure.empty()) throw Error(ErrorKind::kInput, "1 of 1 assets failed", passing);
  throw input_error(shown(report.input) + ": " + std::to_string(report.failed_count()) + " of " +
                    std::to_string(report.materials.size() - report.count(MaterialState::kUntouched)) +
                    " materials failed");
}

AssetList checked_list(const ConvertOptions& options, const std::optional<TreeManifest>& manifest) {
  require_asset_options(options);
  AssetList list = asset_list(options, manifest ? &manifest->listing : nullptr);
  require_gltf(options, list);
  return list;
}

}  // namespace

ConvertOptions meaning_assets(ConvertOptions options) {
  const bool is_gltf = options.to.empty() || options.to.name == "metallic";
  if (options.preset == nullptr && preset_of(options.to.word()) == nullptr && is_gltf)
    options.to = model_name().read("--to", "gltf");
  if (options.output.empty() && options.more_assets.size() == 1)
    options.output = std::exchange(options.more_assets, {}).front();
  return options;
}

bool are_assets(const ConvertOptions& options, const std::optional<TreeManifest>& manifest) {
  if (manifest ? manifest->head.kind == ListedKind::kAssets : options.assets || is_asset(options.folder))
    return true;
  refuse(options, kNeedsAsset,
         ": applies to assets alone (remove it, name a glTF, MTL or OBJ file, or --assets)");
  return false;
}

void check_assets(const ConvertOptions& options, const std::optional<TreeManifest>& manifest) {
  (void)checked_list(meaning_assets(options), manifest);
}

void convert_assets(const ConvertOptions& options, const std::optional<TreeManifest>& manifest) {
  const Stopwatch stopwatch;
  const AssetList list = checked_list(options, manifest);
  const bool is_one = list.jobs.size() == 1 && !list.is_tree;
  const ConversionNote conversion = conversion_of_assets(options);
  RunLines lines(options);
  if (options.part) lines.tell(part_json(*options.part, manifest->head, conversion));
  for (const std::string& problem : list.problems) print_message(kProgram, "failed: " + problem);
  const std::vector<AssetReport> reports =
      run_assets(list, options, conversion, [&](const AssetReport& report) {
        print_asset(report, options.dry_run, options.quiet);
        const Json json = asset_json(report, options.dry_run);
        if (!is_one)
          lines.tell(json);
        else if (options.json)
          std::cout << json.dump(2) << std::endl;
      });
  AssetSummary summary = summary_of(reports);
  summary.problems = list.problems;
  summary.seconds = stopwatch.seconds();
  summary.used = resource_use();
  if (!is_one && !options.quiet) print_message(kProgram, summary_text(summary, options.dry_run));
  if (!is_one) lines.tell(summary_json(summary));
  lines.finish();
  require_success(reports, summary);
}

}  // namespace remap
