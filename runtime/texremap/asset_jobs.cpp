#include "texremap/asset_jobs.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "assets/asset_uri.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/parallel.hpp"
#include "core/plain_text.hpp"
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
  const std::vector<fs::path> inputs = named_assets(options);
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

// Gives each asset the names that it will write: its result, copies of what it names, and what its new images
// begin with. Of two that would write one file the second is refused, or names its new images otherwise.
class NamePlan {
 public:
  explicit NamePlan(AssetList& list) : list_(list) {}

  void take_results() {
    for (AssetJob& job : list_.jobs) {
      take(job, job.output, owner_of_results(job));
      if (name_key(job.input) != name_key(job.output)) take(job, job.input, shown(job.input));
    }
  }

  void take_files() {
    run_parallel(list_.jobs.size(), 0, [&](std::size_t i) { list_.jobs[i].files = files_of(list_.jobs[i]); });
    for (AssetJob& job : list_.jobs)
      for (const fs::path& file : job.files)
        for (const fs::path& name : {file, job.copy_of(file)}) {
          take(job, name, shown(file));
          note_name(name);
        }
  }

  // New images are named after images that the asset names. Where two assets name images of one stem, and
  // where a new image could have the name of a file of another one, their names begin with that of the asset:
  // `chair_`, or `chair_2_` where another asset has that.
  void set_prefixes() {
    for (AssetJob& job : list_.jobs) take_stems(job);
    for (AssetJob& job : list_.jobs) {
      for (std::size_t number = 1; !may_have_stems(job); ++number)
        job.image_prefix =
            job.input.stem().string() + (number == 1 ? "_" : "_" + std::to_string(number) + "_");
      take_stems(job);
    }
  }

 private:
  // Who names new images after a stem; null for several.
  using Stems = std::unordered_map<std::string, const AssetJob*>;

  void take(AssetJob& job, const fs::path& name, const std::string& owner) {
    const std::string other = list_.names->take(name, owner);
    if (other.empty() || !job.refusal.empty()) return;
    job.refusal = shown(name) + ": would be written twice, from " + other + " and from " + owner +
                  " (convert them into two folders, or rename one)";
  }

  // As take_stems() names it.
  static std::string stem_of(const fs::path& name) {
    const std::string key = name_key(name);
    return key.substr(0, key.size() - fs::path(key).extension().string().size());
  }

  // The stem after which a new image could have this name, if there is one: `wood` for
  // `wood_roughness_2.png`.
  void note_name(const fs::path& name) {
    std::string stem = stem_of(name);
    const std::size_t digits = stem.find_last_not_of("0123456789");
    if (digits != std::string::npos && stem[digits] == '_' && digits + 1 < stem.size()) stem.resize(digits);
    for (const std::string_view suffix : kNewImageSuffixes)
      if (stem.ends_with(without_case(suffix)))
        names_[stem.substr(0, stem.size() - suffix.size())].insert(name);
  }

  void take_stems(const AssetJob& job) {
    for (const std::string& stem : stems_of(job)) {
      const auto [found, is_new] = stems_.try_emplace(stem, &job);
      if (!is_new && found->second != &job) found->second = nullptr;
    }
  }

  static std::vector<std::string> stems_of(const AssetJob& job) {
    std::vector<std::string> stems;
    for (const fs::path& file : job.files)
      stems.push_back(name_key(stem_beside(job.copy_of(file).generic_string(), job.image_prefix, "")));
    return stems;
  }

  bool may_have_stems(const AssetJob& job) const {
    return std::ranges::all_of(stems_of(job), [&](const std::string& stem) {
      if (const auto found = stems_.find(stem); found != stems_.end() && found->second != &job) return false;
      const auto named = names_.find(stem);
      return named == names_.end() || std::ranges::all_of(named->second, [&](const fs::path& name) {
               return std::ranges::any_of(job.files, [&](const fs::path& file) {
                 return file == name || job.copy_of(file) == name;
               });
             });
    });
  }

  AssetList& list_;
  Stems stems_;
  std::unordered_map<std::string, std::set<fs::path>> names_;  // of files, by the stem that could give them
};

}  // namespace

std::string owner_of_results(const AssetJob& job) { return "the conversion of " + shown(job.input); }

std::vector<fs::path> named_assets(const ConvertOptions& options) {
  std::vector<fs::path> inputs = {options.folder};
  inputs.insert(inputs.end(), options.more_assets.begin(), options.more_assets.end());
  return inputs;
}

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
  NamePlan names(list);
  names.take_results();
  if (listing == nullptr && list.jobs.size() > 1) {
    names.take_files();
    names.set_prefixes();
  }
  if (!list.is_tree)  // the user has typed their names
    for (const AssetJob& job : list.jobs)
      if (!job.refusal.empty()) throw usage_error(job.refusal);
  return list;
}

Listing listing_of_assets(const fs::path& folder, const std::string& format) {
  ConvertOptions options;
  options.folder = folder;
  options.format = format;
  options.recursive = true;
  AssetList list;
  add_tree(options, list);
  NamePlan names(list);
  names.take_results();
  names.take_files();
  names.set_prefixes();
  Listing listing;
  listing.kind = ListedKind::kAssets;
  for (const AssetJob& job : list.jobs) {
    if (!job.refusal.empty()) {
      listing.found.problems.push_back({{}, job.refusal});
      continue;
    }
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
