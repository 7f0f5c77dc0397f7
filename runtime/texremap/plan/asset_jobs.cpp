#include <algorithm>
#include <set>
#include <unordered_map>

#include "assets/document/asset_uri.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/parallel.hpp"
#include "core/plain_text.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/plan/asset_files.hpp"
#include "texremap/plan/asset_formats.hpp"
#include "texremap/plan/job.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// Returns the name of the result of `chair.gltf`. Its extension changes if the format does.
fs::path result_name(const fs::path& input, const ConvertOptions& options) {
  fs::path name = input;
  if (const std::string extension = result_extension(input, options.format); !extension.empty())
    name.replace_extension(extension);
  return name;
}

AssetWork& asset_in(Job& job) { return std::get<AssetWork>(job.work); }

void add(AssetWork asset, JobList& list) {
  Job& job = list.jobs.emplace_back(Job{asset.input.string()});
  job.owner = "the conversion of " + display_path(asset.input);
  job.work = std::move(asset);
}

// Adds the assets on the command line. --output is a folder, or for one asset a file.
void add_named(const ConvertOptions& options, JobList& list) {
  const std::vector<fs::path> inputs = named_assets(options);
  if (is_asset(options.output)) {
    if (inputs.size() > 1)
      throw usage_error("--output " + options.output.string() +
                        ": is a file, but there are several assets (give a folder)");
    if (!options.asset_root.empty())
      throw usage_error("--output " + options.output.string() +
                        ": is a file, but the results keep the tree of " + options.asset_root.string() +
                        " (give a folder)");
    require_format(options.folder, options.output);
    add({options.folder, options.output, folder_of_asset(options.folder), folder_of_asset(options.output)},
        list);
    return;
  }
  for (const fs::path& input : inputs) {
    const fs::path root = options.asset_root.empty() ? folder_of_asset(input) : options.asset_root;
    const fs::path below = input.lexically_normal().lexically_relative(root.lexically_normal());
    if (below.empty() || *below.begin() == "..")
      throw usage_error(display_path(input) + ": is not inside the folder " + root.string() +
                        ", which is given before it (give a folder that contains the file)");
    add({input, options.output / result_name(below, options), root, options.output}, list);
  }
}

AssetWork asset_in_tree(const fs::path& asset, const ConvertOptions& options) {
  return {options.folder / asset, options.output / result_name(asset, options), options.folder,
          options.output};
}

void add_tree(const ConvertOptions& options, JobList& list) {
  WalkOptions walk_options;
  walk_options.recursive = options.recursive;
  if (!options.output.empty()) walk_options.excluded = {options.output};
  walk_options.also = asset_extensions(options.format);
  Walk walk = walk_images(options.folder, walk_options);
  std::ranges::sort(walk.others);
  for (const fs::path& asset : walk.others) add(asset_in_tree(asset, options), list);
  for (const WalkProblem& problem : walk.problems) list.skipped.push_back({problem.message, true});
  list.is_of_folder = list.has_several = true;
  if (list.jobs.empty())
    throw usage_error(
        display_path(options.folder) + ": contains no " + asset_words(options.format) +
        (options.format.empty() ? "" : ", and --format " + options.format + " applies to OBJ files only") +
        (!options.recursive       ? " (--recursive also searches its subfolders)"
         : options.format.empty() ? " (add --format glb to find OBJ files)"
                                  : " (remove --format to find glTF and MTL files)"));
}

void add_listed(const ConvertOptions& options, const TreeManifest& tree, JobList& list) {
  for (const ListedAsset& asset : tree.assets) {
    if (!is_asset_name(asset.path))
      throw input_error(display_path(asset.path) + ": is not an asset (run texremap index again)");
    AssetWork work = asset_in_tree(asset.path, options);
    work.image_prefix = asset.image_prefix;
    add(std::move(work), list);
    Job& job = list.jobs.back();
    const auto note_size = [&](const fs::path& file) {
      job.listed[options.folder / file] = tree.found.sizes.at(file);
    };
    note_size(asset.path);
    for (const fs::path& file : asset.files) note_size(file);
  }
  for (const WalkProblem& problem : tree.found.problems) list.skipped.push_back({problem.message, true});
  list.is_of_folder = list.has_several = true;
}

// Returns the existing files that an asset names, each once, sorted. An asset that cannot be read, or that
// names a forbidden file, fails later.
std::vector<fs::path> files_of(const AssetWork& asset) {
  std::set<fs::path> files;
  try {
    const FolderResources resources(asset);
    for (const AssetResource& resource :
         resources_of_asset(FileSource(asset.input), asset.input, resources)) {
      if (resource.kind != UriKind::kFile) continue;
      const fs::path file = resources.input(resource.path).lexically_normal();
      std::error_code ignored;
      if (fs::is_regular_file(file, ignored)) files.insert(file);
    }
  } catch (const Error&) {
  }
  return {files.begin(), files.end()};
}

// A NamePlan gives each asset the names that it will write: its result, copies, and the prefix of its new
// images. If two assets would write the same file, it refuses the second, or changes its prefix.
class NamePlan {
 public:
  explicit NamePlan(JobList& list) : list_(list) {}

  void take_results() {
    for (Job& job : list_.jobs) {
      const AssetWork& asset = asset_in(job);
      take(job, asset.output, job.owner);
      if (name_key(asset.input) != name_key(asset.output)) take(job, asset.input, display_path(asset.input));
    }
  }

  void take_files() {
    run_parallel(list_.jobs.size(), 0, [&](std::size_t i) {
      AssetWork& asset = asset_in(list_.jobs[i]);
      asset.files = files_of(asset);
    });
    for (Job& job : list_.jobs) {
      const AssetWork& asset = asset_in(job);
      for (const fs::path& file : asset.files)
        for (const fs::path& name : {file, asset.copy_of(file)}) {
          take(job, name, display_path(file));
          note_name(name);
        }
    }
  }

  // Sets prefixes. A new image is named after an image that the asset uses. If two assets use images of the
  // same name, or if a new image would have the name of a file of another asset, the prefix is the name of
  // the asset: `chair_`. If another asset has this prefix, too, it is `chair_2_`.
  void set_prefixes() {
    for (Job& job : list_.jobs) take_stems(asset_in(job));
    for (Job& job : list_.jobs) {
      AssetWork& asset = asset_in(job);
      for (std::size_t number = 1; !may_have_stems(asset); ++number)
        asset.image_prefix =
            asset.input.stem().string() + (number == 1 ? "_" : "_" + std::to_string(number) + "_");
      take_stems(asset);
    }
  }

 private:
  // Maps a stem to the asset whose new images are named after it, or to null if there are several.
  using Stems = std::unordered_map<std::string, const AssetWork*>;

  void take(Job& job, const fs::path& name, const std::string& owner) {
    const std::string other = list_.names->take(name, owner);
    if (!other.empty() && job.refusal.empty()) job.refusal = written_twice_text(name, other, owner);
  }

  // Returns the name without its extension, as a key of `stems_` and `names_`.
  static std::string stem_of(const fs::path& name) {
    const std::string key = name_key(name);
    return key.substr(0, key.size() - fs::path(key).extension().string().size());
  }

  // Records the stem for which a new image could have this name: `wood` for `wood_roughness_2.png`.
  void note_name(const fs::path& name) {
    std::string stem = stem_of(name);
    const std::size_t digits = stem.find_last_not_of("0123456789");
    if (digits != std::string::npos && stem[digits] == '_' && digits + 1 < stem.size()) stem.resize(digits);
    for (const std::string_view suffix : kNewImageSuffixes)
      if (stem.ends_with(without_case(suffix)))
        names_[stem.substr(0, stem.size() - suffix.size())].insert(name);
  }

  void take_stems(const AssetWork& asset) {
    for (const std::string& stem : stems_of(asset)) {
      const auto [found, is_new] = stems_.try_emplace(stem, &asset);
      if (!is_new && found->second != &asset) found->second = nullptr;
    }
  }

  static std::vector<std::string> stems_of(const AssetWork& asset) {
    std::vector<std::string> stems;
    for (const fs::path& file : asset.files)
      stems.push_back(name_key(stem_beside(asset.copy_of(file).generic_string(), asset.image_prefix, "")));
    return stems;
  }

  bool may_have_stems(const AssetWork& asset) const {
    return std::ranges::all_of(stems_of(asset), [&](const std::string& stem) {
      if (const auto found = stems_.find(stem); found != stems_.end() && found->second != &asset)
        return false;
      const auto named = names_.find(stem);
      return named == names_.end() || std::ranges::all_of(named->second, [&](const fs::path& name) {
               return std::ranges::any_of(asset.files, [&](const fs::path& file) {
                 return file == name || asset.copy_of(file) == name;
               });
             });
    });
  }

  JobList& list_;
  Stems stems_;
  std::unordered_map<std::string, std::set<fs::path>> names_;  // keyed by stems for which they may be made
};

}  // namespace

std::vector<fs::path> named_assets(const ConvertOptions& options) {
  std::vector<fs::path> inputs = {options.folder};
  inputs.insert(inputs.end(), options.more_assets.begin(), options.more_assets.end());
  return inputs;
}

bool is_asset(const fs::path& path) {
  std::error_code ignored;
  return is_asset_name(path) && !fs::is_directory(path, ignored);
}

JobList asset_jobs(const ConvertOptions& options, const TreeManifest* listed) {
  JobList list;
  list.kind = ListedKind::kAssets;
  if (listed != nullptr)
    add_listed(options, *listed, list);
  else
    options.assets ? add_tree(options, list) : add_named(options, list);
  list.has_several |= list.jobs.size() > 1;
  NamePlan names(list);
  names.take_results();
  if (listed == nullptr && list.jobs.size() > 1) {
    names.take_files();
    names.set_prefixes();
  }
  if (!list.is_of_folder)  // the user has typed their names
    for (const Job& job : list.jobs)
      if (!job.refusal.empty()) throw usage_error(job.refusal);
  return list;
}

TreeManifest tree_of_assets(const fs::path& folder, const std::string& format) {
  ConvertOptions options;
  options.folder = folder;
  options.format = format;
  options.recursive = true;
  JobList list;
  add_tree(options, list);
  NamePlan names(list);
  names.take_results();
  names.take_files();
  names.set_prefixes();
  TreeManifest tree;
  tree.head.kind = ListedKind::kAssets;
  for (Job& job : list.jobs) {
    if (!job.refusal.empty()) {
      tree.found.problems.push_back({{}, job.refusal});
      continue;
    }
    const AssetWork& work = asset_in(job);
    ListedAsset& asset = tree.assets.emplace_back();
    asset.path = work.name();
    asset.image_prefix = work.image_prefix;
    for (const fs::path& file : work.files)
      asset.files.push_back(file.lexically_relative(folder.lexically_normal()));
  }
  for (const SkippedEntry& problem : list.skipped) tree.found.problems.push_back({{}, problem.message});
  return tree;
}

}  // namespace remap
