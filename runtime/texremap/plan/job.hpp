// The jobs of `texremap convert`: texture sets, tiles of sets, and assets.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "texremap/plan/manifest.hpp"
#include "texremap/plan/written_names.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// The folder that the files of an asset are relative to.
std::filesystem::path folder_of_asset(const std::filesystem::path& asset);

// One set of single files: a texture set, or one tile of it.
struct SetWork {
  TextureSetRequest request;
  std::filesystem::path folder, diagnosis_folder;  // where the results go
  ResultNames names;                               // of results without an input of the same name
  std::vector<CopiedFile> copies;
  std::vector<std::filesystem::path> left_behind;  // maps of the set that are neither read nor copied
  std::vector<std::string> notes;                  // which of several maps were taken
};

// An asset and its result. Files that it names are read below `input_root` and written to the same places
// below `output_root`.
struct AssetWork {
  std::filesystem::path input, output;
  std::filesystem::path input_root, output_root;
  std::string image_prefix = {};                  // of new images beside it
  std::vector<std::filesystem::path> files = {};  // that it names and that are there; of several assets only

  // Returns the path of the copy that the result uses for `file`, a file below the input root.
  std::filesystem::path copy_of(const std::filesystem::path& file) const {
    return output_root / file.lexically_relative(input_root.lexically_normal());
  }
  // The path below the root, as bytes.
  std::string name() const { return input.lexically_relative(input_root).generic_string(); }
};

struct Job {
  // Path of the set or the asset, as bytes; empty for the one set of a command line. Messages use
  // display_path().
  std::string name;
  std::string tile = {};     // number of the tile; empty where there are none
  std::string owner = {};    // of the names of its results, for WrittenNames: two sets may have one name
  ListedSizes listed = {};   // sizes of files that a manifest states
  std::string refusal = {};  // why it is not converted; empty for none
  std::variant<SetWork, AssetWork> work = {};

  // The folders of its results and copies.
  std::vector<std::filesystem::path> folders() const;
};

// A set that is not converted, or a file or folder that cannot be read.
struct SkippedEntry {
  std::string message;
  bool is_failure = false;  // false where there was nothing to convert
};

struct JobList {
  ListedKind kind = ListedKind::kSets;
  std::vector<Job> jobs;  // the tiles of a set follow one another
  std::shared_ptr<WrittenNames> names = std::make_shared<WrittenNames>();  // results, inputs and copies
  std::vector<SkippedEntry> skipped;
  std::vector<std::string> notes;                   // about all sets
  std::vector<std::filesystem::path> unrecognised;  // images of a folder whose names no habit matches
  std::size_t asset_count = 0;                      // assets in a folder of sets, which are left as they are
  bool is_of_folder = false;       // of a folder or a manifest: the output folder belongs to this conversion
  bool has_several = false;        // a job that fails does not stop the others
  std::string tile_noun = "tile";  // "frame" for sequences
};

}  // namespace remap
