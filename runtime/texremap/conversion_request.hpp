// What the options of `texremap convert` ask for, as the texture library takes it.
#pragma once

#include <string>
#include <vector>

#include "convert/instruction_set.hpp"
#include "texremap/convert_options.hpp"
#include "texremap/workflow_choice.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_pass.hpp"

namespace remap {

// Each throws kUsage, naming the option, for what there is not.
TextureSetRequest set_request(const ConvertOptions& options, const WorkflowChoice& workflow);
// Of the one set that the options name.
std::vector<CopiedFile> copied_files(const ConvertOptions& options, const WorkflowChoice& workflow);
TargetChoice target_choice(const ConvertOptions& options, const WorkflowChoice& workflow);
PassOptions pass_options(const ConvertOptions& options);
// The options that results depend on, as one text.
std::string result_options_text(const ConvertOptions& options);
InstructionSet chosen_instructions(const ConvertOptions& options);
int thread_count(const ConvertOptions& options);

}  // namespace remap
