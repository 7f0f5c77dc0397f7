// One picture of a table and the fits to it: both targets with the curves of the fits, and what they leave.
#pragma once

#include <filesystem>
#include <vector>

#include "model/fit.hpp"
#include "table/table.hpp"

namespace remapc {

// Throws kUsage where `path` does not end with .svg, kOutput where its folder cannot be made or gnuplot is
// missing: before the work whose result is plotted.
void require_plot(const std::filesystem::path& path);

// Writes the plot as SVG. `fits`: one to six, all of `table` and of one domain. At most 2000 usable rows are
// drawn, chosen evenly. Throws kOutput where gnuplot fails or the file cannot be written.
void write_plot(const std::filesystem::path& path, const Table& table, const std::vector<remap::Fit>& fits);

// `parametric paper`, `svr`, `mlp`: the kind, and its form where it has one.
std::string fit_label(const remap::Fit& fit);

}  // namespace remapc
