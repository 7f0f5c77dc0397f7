// The jobs of `texremap convert`: the one set of the command line, its tiles, or the sets of a folder. Each
// job converts a set of single files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sets/discovery.hpp"
#include "texremap/convert_options.hpp"
#include "texremap/workflow_choice.hpp"
#include "texremap/written_names.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// One set of single files: a texture set, or one tile of it.
struct ConversionJob {
  std::string name;  // path of the set, as bytes; messages use shown()
  std::string tile;  // number of the tile; empty where the set has no tiles
  TextureSetRequest request;
  std::filesystem::path folder, diagnosis_folder;  // where the results go
  ResultNames names;                               // of results without an input of the same name
  std::vector<CopiedFile> copies;
  std::vector<std::filesystem::path> left_behind;          // maps of the set that are neither read nor copied
  std::vector<std::string> notes;                          // which of several maps were taken
  std::map<std::filesystem::path, std::uintmax_t> listed;  // sizes of files that a manifest states
  std::string owner = {};  // of the names of its results, for WrittenNames: two sets may have one name
};

// A set that is not converted, or a file or folder that cannot be read.
struct SkippedSet {
  std::string message;
  bool is_failure = false;  // false where there was nothing to convert
};

struct JobList {
  std::vector<ConversionJob> jobs;
  std::shared_ptr<WrittenNames> names = std::make_shared<WrittenNames>();  // results, inputs and copies
  std::vector<SkippedSet> left_out;
  std::vector<std::string> notes;                   // about all sets
  std::vector<std::filesystem::path> unrecognised;  // images of a folder whose names no habit matches
  std::size_t asset_count = 0;                      // assets in the folder, which are left as they are
  bool is_tree = false;            // several sets or tiles; a failing one does not stop the others
  std::string tile_noun = "tile";  // "frame" for sequences
};

// The sets of the folder that the options name; none without a folder. Throws kInput if it, or a naming file,
// cannot be read.
std::optional<Discovery> discovered_sets(const ConvertOptions& options);

// `request` is what the options say about one set, or about all sets of a folder. Throws kUsage if the folder
// has no sets; of two sets that would write one file the second is left out. Throws kInput if the folder or a
// naming file cannot be read.
JobList conversion_jobs(const ConvertOptions& options, const WorkflowChoice& workflow,
                        const TextureSetRequest& request, std::optional<Discovery> sets);

}  // namespace remap
