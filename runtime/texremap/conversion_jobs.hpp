// What `texremap convert` has to do, as a list of sets of single files: the one set of the command line, its
// tiles, or the sets of a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "texremap/convert_options.hpp"
#include "texremap/workflow_choice.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// One set of files, one tile of a set.
struct ConversionJob {
  std::string name;  // of the set, for people
  std::string tile;  // its number; empty where the set has none
  TextureSetRequest request;
  std::filesystem::path folder;  // of the results
  ResultNames names;             // of results that have no input
  std::vector<CopiedFile> copies;
};

// A set that is not converted, or a file or folder that cannot be looked at.
struct LeftOut {
  std::string message;
  bool is_failure = false;  // rather than nothing to do
};

struct JobList {
  std::vector<ConversionJob> jobs;
  std::vector<LeftOut> left_out;
  std::size_t unrecognised_count = 0;  // images of a folder that no naming habit knows
  bool is_tree = false;                // many sets, or tiles: failures of one do not stop the others
  std::string tile_noun = "tile";      // or frame
};

// `request`: what the options say of one set, or of all sets of a folder. Throws kUsage for a folder without
// sets and where two sets would write one file; kInput where the folder or a naming file cannot be read.
JobList conversion_jobs(const ConvertOptions& options, const WorkflowChoice& workflow,
                        const TextureSetRequest& request);

}  // namespace remap
