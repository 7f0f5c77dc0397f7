// This file lists the texture sets that a run converts: the one on the command line, its tiles, or the sets
// of a folder or a manifest. In the set of a job, each map is one file.
#pragma once

#include <optional>

#include "sets/discovery.hpp"
#include "texremap/options/convert_options.hpp"
#include "texremap/plan/job.hpp"
#include "texremap/plan/workflow_choice.hpp"

namespace remap {

// Finds the sets of the folder in the options. Returns nothing without a folder. Throws kInput if the folder
// or a naming file cannot be read.
std::optional<Discovery> discovered_sets(const ConvertOptions& options);

// `request` holds what the options give for one set, or for all sets of a folder. If two sets would write the
// same file, the second is skipped. Throws kUsage if the folder has no sets, and kInput if the folder or a
// naming file cannot be read.
JobList set_jobs(const ConvertOptions& options, const ConversionChoice& workflow,
                 const TextureSetRequest& request, std::optional<Discovery> sets);

}  // namespace remap
