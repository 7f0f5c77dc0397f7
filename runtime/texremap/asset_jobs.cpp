#include "texremap/asset_jobs.hpp"

#include <algorithm>
#include <map>
#include <mutex>
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

void add_tree(const ConvertOptions& options, AssetList& list) {
  WalkOptions walk_options;
  walk_options.recursive = options.recursive;
  walk_options.excluded = {options.output};
  walk_options.also = asset_extensions(options.format);
  Walk walk = walk_images(options.folder, walk_options);
  std::ranges::sort(walk.others);
  for (const fs::path& asset : walk.others)
    list.jobs.push_back({options.folder / asset, options.output / result_name(asset, options), options.folder,
                         options.output, ""});
  for (const WalkProblem& problem : walk.problems) list.problems.push_back(problem.message);
  list.is_tree = true;
  if (list.jobs.empty())
    throw usage_error(shown(options.folder) + ": no " + asset_words(options.format) + " in it" +
                      (options.recursive ? "" : " (--recursive looks into its subfolders)"));
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

// Two assets that name one image may each add another one beside it: their new images begin with the names of
// the assets. An asset that cannot be read fails later.
void set_prefixes(AssetList& list) {
  if (list.jobs.size() < 2) return;
  std::mutex mutex;
  std::map<fs::path, std::set<AssetJob*>> users;  // by file
  run_parallel(list.jobs.size(), 0, [&](std::size_t i) {
    AssetJob& job = list.jobs[i];
    try {
      for (const AssetResource& resource :
           resources_of_asset(FileSource(job.input), job.input, FolderResources(job)))
        if (resource.kind == UriKind::kFile) {
          const std::lock_guard lock(mutex);
          users[(folder_of_asset(job.input) / resource.path).lexically_normal()].insert(&job);
        }
    } catch (const Error&) {
    }
  });
  for (const auto& [file, jobs] : users)
    if (jobs.size() > 1)
      for (AssetJob* job : jobs) job->image_prefix = job->input.stem().string() + "_";
}

}  // namespace

bool is_asset(const fs::path& path) {
  std::error_code ignored;
  return is_asset_name(path) && !fs::is_directory(path, ignored);
}

AssetList asset_list(const ConvertOptions& options) {
  AssetList list;
  options.assets ? add_tree(options, list) : add_named(options, list);
  require_distinct(list);
  set_prefixes(list);
  return list;
}

}  // namespace remap
