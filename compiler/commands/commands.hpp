// This file declares the commands of remapc. Each function adds one command to the command line. The
// command's callback does the work and throws remap::Error.
#pragma once

#include "command_line/command.hpp"

namespace remap {

// `remapc --help` lists the commands under these headings, in the order in which people use them.
inline constexpr const char* kMeasureStage = "Measure";
inline constexpr const char* kFitStage = "Fit";
inline constexpr const char* kCompileStage = "Compile";
inline constexpr const char* kLookStage = "Look";
inline constexpr const char* kRendererStage = "Renderers";
inline constexpr const char* kWarpStage = "Warp";

void add_sweep_command(Command& app);
void add_sample_command(Command& app);
void add_render_command(Command& app);
void add_check_command(Command& app);
void add_export_command(Command& app);

void add_fit_command(Command& app);
void add_compare_command(Command& app);

void add_emit_command(Command& app);
void add_chain_command(Command& app);
void add_invert_command(Command& app);
void add_build_command(Command& app);

void add_list_command(Command& app);
void add_show_command(Command& app);
void add_preview_command(Command& app);
void add_eval_command(Command& app);

void add_renderers_command(Command& app);

void add_warp_command(Command& app);

}  // namespace remap
