// This file describes the jobs of `texremap convert`: texture sets, tiles of sets, and assets. It lists them
// from the command line, a folder, or a manifest.
#pragma once

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "remap/surface.hpp"
#include "sets/discovery.hpp"
#include "texremap/options/convert_options.hpp"
#include "texremap/plan/manifest.hpp"
#include "texremap/plan/workflow_choice.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// Returns the name as macOS and Windows compare it: absolute, without `.` and `..`, and without case. It does
// not follow links.
std::string name_key(const std::filesystem::path& path);

// A WrittenNames records every file that a run writes, by its final name, with its owner. Names are planned
// before work starts, so that two sets or assets never write the same file.
class WrittenNames {
 public:
  // Reserves the name of a file for `owner`: an asset, a set, or the file that is copied. Returns the other
  // owner if the name is reserved already, otherwise an empty text. The program's own names are never free.
  // Safe to call from many threads.
  std::string take(const std::filesystem::path& path, const std::string& owner);

 private:
  std::mutex mutex_;
  std::unordered_map<std::string, std::string> owners_;  // keyed by name_key()
};

// Returns a message that two owners would write the same file, and what to do.
std::string written_twice_text(const std::filesystem::path& path, const std::string& first,
                               const std::string& second);

// Returns the folder that the files of an asset are relative to.
std::filesystem::path folder_of_asset(const std::filesystem::path& asset);

// A SetWork is a texture set without tiles, or one tile of a set, so that each map is one file.
struct SetWork {
  TextureSetRequest request;
  std::filesystem::path folder, diagnosis_folder;  // folders for the results
  ResultNames names;                               // names of results without an input of the same name
  std::vector<CopiedFile> copies;
  std::vector<std::filesystem::path> left_behind;  // maps of the set that are neither read nor copied
  std::vector<std::string> notes;                  // which map was chosen out of several
  std::optional<TranslationEffect> effect = {};    // what a translation between surfaces changes in this set
  // These maps are not converted, but pictures show them. A file without a name is missing.
  MapName diffuse = {};
  std::filesystem::path normals = {};
  NormalGreen green = NormalGreen::kUp;  // direction of green in the normals
};

// An AssetWork is an asset and its result. The files that the asset names are read below `input_root`, and
// copied to the same places below `output_root`.
struct AssetWork {
  std::filesystem::path input, output;
  std::filesystem::path input_root, output_root;
  std::string image_prefix = {};                  // prefix of the new images beside the result
  std::vector<std::filesystem::path> files = {};  // existing files that it uses, if there are several assets

  // Returns the path of the copy of `file`, which lies below the input root.
  std::filesystem::path copy_of(const std::filesystem::path& file) const {
    return output_root / file.lexically_relative(input_root.lexically_normal());
  }
  // Returns the path below the root, as bytes.
  std::string name() const { return input.lexically_relative(input_root).generic_string(); }
};

struct Job {
  // Holds the path of the set or the asset, as bytes. It is empty for the only set of a command line.
  // Messages use display_path().
  std::string name;
  std::string tile = {};     // number of the tile, or empty
  std::string owner = {};    // owner of the results in WrittenNames, because two sets may have one name
  ListedSizes listed = {};   // sizes of files from a manifest
  std::string refusal = {};  // why the job is not converted, or empty
  std::variant<SetWork, AssetWork> work = {};

  // Returns the folders of the results and copies.
  std::vector<std::filesystem::path> folders() const;
};

// A SkippedEntry is a set that is not converted, or a file or folder that cannot be read.
struct SkippedEntry {
  std::string message;
  bool is_failure = false;  // false if there was nothing to convert
};

struct JobList {
  ListedKind kind = ListedKind::kSets;
  std::vector<Job> jobs;  // the tiles of a set are neighbours
  std::shared_ptr<WrittenNames> names = std::make_shared<WrittenNames>();  // results, inputs and copies
  std::vector<SkippedEntry> skipped;
  std::vector<std::string> notes;                   // about all sets together
  std::vector<std::filesystem::path> unrecognised;  // images of a folder that match no naming convention
  std::size_t asset_count = 0;                      // unconverted assets in a folder of sets
  // If the jobs come from a folder or a manifest, the output folder belongs to this conversion.
  bool is_of_folder = false;
  bool has_several = false;        // if one job fails, the others go on
  std::string tile_noun = "tile";  // "frame" for sequences
};

// Returns the assets on the command line.
std::vector<std::filesystem::path> named_assets(const ConvertOptions& options);

// Returns true if the name belongs to an asset that this program reads.
bool is_asset(const std::filesystem::path& path);

// Returns the jobs of the assets in `listed`, the content of a manifest, or if it is null, of the assets that
// the options name. If an asset would write a file of another asset, its job gets a refusal. For assets on
// the command line, throws kUsage instead. Also throws kUsage if a folder has no assets, and kInput if the
// folder cannot be read.
JobList asset_jobs(const ConvertOptions& options, const TreeManifest* listed);

// Returns the assets of a folder as a manifest lists them. `format` is the target of OBJ files, or empty.
// Throws like asset_jobs().
TreeManifest tree_of_assets(const std::filesystem::path& folder, const std::string& format);

// Finds the sets of the folder in the options. Returns nothing without a folder. Throws kInput if the folder
// or a naming file cannot be read.
std::optional<Discovery> discovered_sets(const ConvertOptions& options);

// `request` holds what the options give for one set, or for all sets of a folder. If two sets would write the
// same file, the second is skipped. Throws kUsage if the folder has no sets, and kInput if the folder or a
// naming file cannot be read.
JobList set_jobs(const ConvertOptions& options, const ConversionChoice& workflow,
                 const TextureSetRequest& request, std::optional<Discovery> sets);

}  // namespace remap
