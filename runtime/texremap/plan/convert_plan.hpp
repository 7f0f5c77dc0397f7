// ConvertPlan holds what a run of `texremap convert` does. All options are interpreted here, so that the code
// that runs and reports needs no options.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "assets/document/asset.hpp"
#include "texremap/options/convert_options.hpp"
#include "texremap/plan/converter_text.hpp"
#include "texremap/plan/job.hpp"
#include "texremap/plan/manifest.hpp"
#include "texture/target_plan.hpp"

namespace remap {

// A SetPlan is the conversion of texture sets, or of numbers.
struct SetPlan {
  UsedConverters converters;  // `chosen` is made from them
  BuiltConversion chosen;
  TextureSetRequest request;  // what the options request, for one set or for all sets of a folder
  TargetChoice targets;       // members that differ between sets are not set yet
  F0Choice dielectric_f0;
  bool scales_exponents = false;  // true if the exponent that a stored 1 means is known for the results
  std::string source_name = {}, target_name = {};  // aliases that the user typed, otherwise the models
};

struct ConvertPlan : RunOptions {
  std::variant<SetPlan, AssetOptions> work;
  JobList list;  // no jobs if all maps are numbers
  ConversionNote conversion;

  std::string command;  // the command line, as text
  int threads = 1;
  std::uint64_t memory_bytes = 0;  // memory for images, in all threads
  ManifestHead manifest;
  std::vector<std::string> messages;  // `warning: ...` and `note: ...` about assumptions

  // Returns null for assets.
  const SetPlan* sets() const { return std::get_if<SetPlan>(&work); }
  bool is_of_numbers() const { return list.jobs.empty() && list.skipped.empty() && !list.is_of_folder; }
};

// Checks everything that can be checked before the first image is opened: options, converter, and the names
// of all files in folders. Throws kUsage with the option, and kInput for files that cannot be read.
ConvertPlan resolve(ConvertOptions options);

}  // namespace remap
