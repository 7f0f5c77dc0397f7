#include "texremap/convert_assets.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <set>

#include "assets/gltf_asset.hpp"
#include "command_line/interruption.hpp"
#include "command_line/run_app.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/stopwatch.hpp"
#include "sets/folder_walk.hpp"
#include "sets/name_pieces.hpp"
#include "texremap/asset_files.hpp"
#include "texremap/asset_report.hpp"
#include "texremap/commands.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// The options of `texremap convert` that apply to assets.
constexpr std::array<std::string_view, 13> kAssetOptions = {
    "DIR",     "ASSET",     "--from", "--to",    "--profile",      "--prior",   "--output",
    "--force", "--dry-run", "--json", "--quiet", "--instructions", "--resample"};

std::string asset_extension(const fs::path& path) {
  const std::string extension = lower(path.extension().string());
  return extension == ".gltf" || extension == ".glb" ? extension : "";
}

bool is_asset(const fs::path& path) {
  std::error_code ignored;
  return !asset_extension(path).empty() && !fs::is_directory(path, ignored);
}

void require_asset_options(const ConvertOptions& options) {
  for (const GivenOption& option : options.given)
    if (std::ranges::find(kAssetOptions, option.name) == kAssetOptions.end())
      throw usage_error(option.name + ": applies to nothing, because " + shown(options.folder) +
                        " is a glTF file (remove this option)");
  for (const fs::path& path : options.more_assets)
    if (!is_asset(path)) throw usage_error(shown(path) + ": is no glTF file (.gltf or .glb)");
  if (!options.from.empty() && options.from.name != "gltf-specgloss")
    throw usage_error("--from " + options.from.name +
                      ": the materials of a glTF file are gltf-specgloss (or leave --from out)");
  if (options.to.empty()) throw usage_error("--to is required (gltf)");
  if (options.to.name != "gltf")
    throw usage_error("--to " + options.to.name + ": materials of a glTF file become gltf");
  if (options.output.empty()) throw usage_error("--output is required");
}

struct AssetJob {
  fs::path input, output;
};

// --output is a folder, or for one asset a file.
std::vector<AssetJob> asset_jobs(const ConvertOptions& options) {
  std::vector<fs::path> inputs = {options.folder};
  inputs.insert(inputs.end(), options.more_assets.begin(), options.more_assets.end());
  std::vector<AssetJob> jobs;
  if (is_asset(options.output)) {
    if (inputs.size() > 1)
      throw usage_error("--output " + options.output.string() +
                        ": is a file, but there are several assets (name a folder)");
    if (asset_extension(options.output) != asset_extension(options.folder))
      throw usage_error("--output " + options.output.string() + ": " + shown(options.folder) +
                        " stays a file of its kind (name it *" + asset_extension(options.folder) + ")");
    return {{options.folder, options.output}};
  }
  for (const fs::path& input : inputs) {
    const fs::path output = options.output / input.filename();
    for (const AssetJob& other : jobs)
      if (other.output == output)
        throw usage_error(output.string() + ": would be written twice, from " + shown(other.input) +
                          " and from " + shown(input) + " (convert them into two folders)");
    jobs.push_back({input, output});
  }
  return jobs;
}

void require_free(const AssetJob& job, bool force) {
  if (same_file(job.input, job.output) && !force)
    throw output_error(shown(job.output) + ": is the input itself (--force replaces it)");
  require_new(job.output, force);
}

class AssetConverter {
 public:
  explicit AssetConverter(const ConvertOptions& options)
      : options_(options),
        conversion_{options.profile, options.prior, options.instructions, options.resample} {}

  void run(const AssetJob& job, AssetReport& report) {
    const Stopwatch stopwatch;
    report.input = job.input;
    report.output = job.output;
    require_free(job, options_.force);
    const FileSource source(job.input);
    const FolderResources files(folder_of_asset(job.input));
    const AssetConversion conversion = convert_gltf(source, shown(job.input), conversion_, &files);
    report.materials = conversion.materials;
    report.warnings = conversion.warnings;
    const ResourcePlan plan = plan_resources(job.input, job.output, conversion.resources, options_.force);
    report.warnings.insert(report.warnings.end(), plan.warnings.begin(), plan.warnings.end());
    // A file of which nothing was converted and something failed would be taken for a result.
    report.is_written = conversion.changed || report.failed_count() == 0;
    if (report.is_written)
      for (const ResourceCopy& copy : plan.copies) report.copies.push_back(copy.to);
    for (const NewResource& file : conversion.files) report.images.push_back(free_place(job, file));
    if (report.is_written && !options_.dry_run) write(job, source, conversion, plan);
    report.seconds = stopwatch.seconds();
  }

 private:
  // Where a new image goes. Throws kOutput where another file is.
  fs::path free_place(const AssetJob& job, const NewResource& file) {
    const fs::path place = folder_of_asset(job.output) / file.path;
    std::error_code ignored;
    const bool is_same = fs::is_regular_file(place, ignored) && have_same_bytes(place, file.bytes);
    const bool is_first = written_.insert(place.lexically_normal()).second;
    if (!is_first && !is_same)
      throw output_error(shown(place) +
                         ": is a new image of another asset, too (convert them into two folders)");
    if (!is_same) require_new(place, options_.force);
    return place;
  }

  // The asset comes last, so that it never lies without its parts.
  static void write(const AssetJob& job, const ByteSource& source, const AssetConversion& conversion,
                    const ResourcePlan& plan) {
    for (const ResourceCopy& copy : plan.copies) {
      create_parent(copy.to);
      copy_whole_file(copy.from, copy.to);
    }
    for (const NewResource& file : conversion.files)
      write_file(folder_of_asset(job.output) / file.path, file.bytes);
    if (conversion.changed)
      write_pieces(job.output, conversion.pieces, source);
    else if (!same_file(job.input, job.output))
      write_pieces(job.output, {{"", 0, source.size()}}, source);
  }

  const ConvertOptions& options_;
  AssetOptions conversion_;
  std::set<fs::path> written_;  // new images
};

void print_as_json(const AssetReport& report, const ConvertOptions& options, bool is_line) {
  std::cout << asset_json(report, options.dry_run).dump(is_line ? -1 : 2) << std::endl;
}

// Throws where an asset or some of its materials failed.
void require_success(const std::vector<AssetReport>& reports) {
  const auto failed = std::ranges::count_if(reports, &AssetReport::has_failed);
  if (failed == 0) return;
  if (reports.size() > 1)
    throw input_error(std::to_string(failed) + " of " + std::to_string(reports.size()) + " assets failed");
  const AssetReport& report = reports.front();
  throw input_error(shown(report.input) + ": " + std::to_string(report.failed_count()) + " of " +
                    std::to_string(report.materials.size() - report.count(MaterialState::kUntouched)) +
                    " spec-gloss materials failed");
}

void convert_assets(const ConvertOptions& options) {
  require_asset_options(options);
  const std::vector<AssetJob> jobs = asset_jobs(options);
  AssetConverter converter(options);
  std::vector<AssetReport> reports;
  for (const AssetJob& job : jobs) {
    if (interruption()) throw Error(ErrorKind::kInterrupted, "interrupted: finished assets are complete");
    AssetReport& report = reports.emplace_back();
    try {
      converter.run(job, report);
    } catch (const Error& error) {
      if (jobs.size() == 1) throw;
      report.failure = error.what();
    }
    print_asset(report, options.dry_run, options.quiet);
    if (options.json) print_as_json(report, options, jobs.size() > 1);
  }
  require_success(reports);
}

}  // namespace

bool convert_as_assets(const ConvertOptions& options) {
  if (is_asset(options.folder)) {
    convert_assets(options);
    return true;
  }
  refuse(options, kNeedsAsset, ": applies to glTF files alone (remove it, or name a .gltf or .glb file)");
  return false;
}

}  // namespace remap
