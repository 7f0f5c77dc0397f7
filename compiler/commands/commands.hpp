// The subcommands of remapc: each adds itself to the command line, and does its work in a callback that
// throws.
#pragma once

#include <CLI/CLI.hpp>

namespace remapc {

void add_render_command(CLI::App& app);
void add_sweep_command(CLI::App& app);
void add_sample_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_fit_command(CLI::App& app);
void add_warp_command(CLI::App& app);
void add_emit_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_eval_command(CLI::App& app);
void add_import_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_list_command(CLI::App& app);
void add_renderers_command(CLI::App& app);
void add_worker_check_command(CLI::App& app);
void add_show_command(CLI::App& app);
void add_preview_command(CLI::App& app);
void add_build_command(CLI::App& app);
void add_chain_command(CLI::App& app);
void add_invert_command(CLI::App& app);

}  // namespace remapc
