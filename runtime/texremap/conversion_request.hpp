// Translates the options of `texremap convert` into requests of the texture library.
#pragma once

#include <string>
#include <vector>

#include "remap/instruction_set.hpp"
#include "texremap/convert_options.hpp"
#include "texremap/workflow_choice.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_pass.hpp"

namespace remap {

// Each function throws kUsage, naming the option, for an invalid value.
TextureSetRequest set_request(const ConvertOptions& options, const WorkflowChoice& workflow);
// The files to copy with the one set that the options name.
std::vector<CopiedFile> copied_files(const ConvertOptions& options, const WorkflowChoice& workflow);
TargetChoice target_choice(const ConvertOptions& options, const WorkflowChoice& workflow);
PassOptions pass_options(const ConvertOptions& options);
// All options that the results depend on, as one text to hash.
std::string result_options_text(const ConvertOptions& options);
InstructionSet chosen_instructions(const ConvertOptions& options);
int thread_count(const ConvertOptions& options);

}  // namespace remap
