#include "texremap/asset_jobs.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/parallel.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/asset_formats.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// `chair.gltf` as the name of its result: another extension where the format changes.
fs::path result_name(const fs::path& input, const ConvertOptions& options) {
  fs::path name = input;
  if (const std::string extension = result_extension(input, options.format); !extension.empty())
    name.replace_extension(extension);
  return name;
}

// The assets that the command line names. --output is a folder, or for one asset a file.
void add_named(const ConvertOptions& options, AssetList& list) {
  std::vector<fs::path> inputs = {options.folder};
  inputs.insert(inputs.end(), options.more_assets.begin(), options.more_assets.end());
  if (is_asset(options.output)) {
    if (inputs.size() > 1)
      throw usage_error("--output " + options.output.string() +
                        ": is a file, but there are several assets (name a folder)");
    if (!options.asset_root.empty())
      throw usage_error(
          "--root: cannot be used with an output file, since the tree of results mirrors it "
          "(name a folder)");
    require_format(options.folder, options.output);
    list.jobs.push_back({options.folder, options.output, folder_of_asset(options.folder),
                         folder_of_asset(options.output), ""});
    return;
  }
  for (const fs::path& input : inputs) {
    const fs::path root = options.asset_root.empty() ? folder_of_asset(input) : options.asset_root;
    const fs::path below = input.lexically_normal().lexically_relative(root.lexically_normal());
    if (below.empty() || *below.begin() == "..")
      throw usage_error("--root " + root.string() + ": " + shown(input) + " does not lie below it");
    list.jobs.push_back({input, options.output / result_name(below, options), root, options.output, ""});
  }
}

AssetJob job_in_tree(const fs::path& asset, const ConvertOptions& options) {
  return {options.folder / asset, options.output / result_name(asset, options), options.folder,
          options.output};
}

void add_tree(const ConvertOptions& options, AssetList& list) {
  WalkOptions walk_options;
  walk_options.recursive = options.recursive;
  if (!options.output.empty()) walk_options.excluded = {options.output};
  walk_options.also = asset_extensions(options.format);
  Walk walk = walk_images(options.folder, walk_options);
  std::ranges::sort(walk.others);
  for (const fs::path& asset : walk.others) list.jobs.push_back(job_in_tree(asset, options));
  for (const WalkProblem& problem : walk.problems) list.problems.push_back(problem.message);
  list.is_tree = true;
  if (list.jobs.empty())
    throw usage_error(shown(options.folder) + ": no " + asset_words(options.format) + " in it" +
                      (options.recursive ? "" : " (--recursive looks into its subfolders)"));
}

void add_listed(const ConvertOptions& options, const Listing& listing, AssetList& list) {
  for (const ListedAsset& asset : listing.assets) {
    if (!is_asset_name(asset.path))
      throw input_error(shown(asset.path) + ": is no asset (texremap index again)");
    AssetJob job = job_in_tree(asset.path, options);
    job.image_prefix = asset.image_prefix;
    const auto note_size = [&](const fs::path& file) {
      job.listed[options.folder / file] = listing.found.sizes.at(file);
    };
    note_size(asset.path);
    for (const fs::path& file : asset.files) note_size(file);
    list.jobs.push_back(std::move(job));
  }
  for (const WalkProblem& problem : listing.found.problems) list.problems.push_back(problem.message);
  list.is_tree = true;
}

void require_distinct(const AssetList& list) {
  std::map<fs::path, const AssetJob*> outputs;
  for (const AssetJob& job : list.jobs) {
    const auto [other, is_new] = outputs.try_emplace(job.output.lexically_normal(), &job);
    if (!is_new)
      throw usage_error(job.output.string() + ": would be written twice, from " +
                        shown(other->second->input) + " and from " + shown(job.input) +
                        " (convert them into two folders)");
  }
}

// The files that an asset names and that are there, each once, sorted. An asset that cannot be read, or that
// names what it may not, fails later.
std::vector<fs::path> files_of(const AssetJob& job) {
  std::set<fs::path> files;
  try {
    const FolderResources resources(job);
    for (const AssetResource& resource : resources_of_asset(FileSource(job.input), job.input, resources)) {
      if (resource.kind != UriKind::kFile) continue;
      const fs::path file = resources.input(resource.path).lexically_normal();
      std::error_code ignored;
      if (fs::is_regular_file(file, ignored)) files.insert(file);
    }
  } catch (const Error&) {
  }
  return {files.begin(), files.end()};
}

// Two assets that name one image may each add another one beside it: their new images begin with the names of
// the assets.
void set_files_and_prefixes(AssetList& list) {
  run_parallel(list.jobs.size(), 0, [&](std::size_t i) { list.jobs[i].files = files_of(list.jobs[i]); });
  std::map<fs::path, std::vector<AssetJob*>> users;  // by file
  for (AssetJob& job : list.jobs)
    for (const fs::path& file : job.files) users[file].push_back(&job);
  for (const auto& [file, jobs] : users)
    if (jobs.size() > 1)
      for (AssetJob* job : jobs) job->image_prefix = job->input.stem().string() + "_";
}

}  // namespace

bool is_asset(const fs::path& path) {
  std::error_code ignored;
  return is_asset_name(path) && !fs::is_directory(path, ignored);
}

AssetList asset_list(const ConvertOptions& options, const Listing* listing) {
  AssetList list;
  if (listing != nullptr)
    add_listed(options, *listing, list);
  else
    options.assets ? add_tree(options, list) : add_named(options, list);
  require_distinct(list);
  if (listing == nullptr && list.jobs.size() > 1) set_files_and_prefixes(list);
  return list;
}

Listing listing_of_assets(const fs::path& folder, const std::string& format) {
  ConvertOptions options;
  options.folder = folder;
  options.format = format;
  options.recursive = true;
  AssetList list;
  add_tree(options, list);
  require_distinct(list);
  set_files_and_prefixes(list);
  Listing listing;
  listing.kind = ListedKind::kAssets;
  for (const AssetJob& job : list.jobs) {
    ListedAsset& asset = listing.assets.emplace_back();
    asset.path = job.name();
    asset.image_prefix = job.image_prefix;
    for (const fs::path& file : job.files)
      asset.files.push_back(file.lexically_relative(folder.lexically_normal()));
  }
  for (const std::string& problem : list.problems) listing.found.problems.push_back({{}, problem});
  return listing;
}

}  // namespace remap
