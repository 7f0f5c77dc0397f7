// The texture sets that a run converts: the one of the command line, its tiles, or those of a folder or a
// manifest. Each job converts a set of single files.
#pragma once

#include <optional>

#include "sets/discovery.hpp"
#include "texremap/options/convert_options.hpp"
#include "texremap/plan/job.hpp"
#include "texremap/plan/workflow_choice.hpp"

namespace remap {

// The sets of the folder that the options name; none without a folder. Throws kInput if it, or a naming file,
// cannot be read.
std::optional<Discovery> discovered_sets(const ConvertOptions& options);

// `request` is what the options say about one set, or about all sets of a folder. Throws kUsage if the folder
// has no sets; of two sets that would write one file the second is left out. Throws kInput if the folder or a
// naming file cannot be read.
JobList set_jobs(const ConvertOptions& options, const WorkflowChoice& workflow,
                 const TextureSetRequest& request, std::optional<Discovery> sets);

}  // namespace remap
