// The results of the warps study as text, CSV and a plot.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/image.hpp"
#include "study/warps.hpp"

namespace remapc {

// Means over sets and strokes, one line for each variant, and an explanation of the columns.
std::string warps_text(const WarpsOptions& options, const WarpsResult& result);

// CSV: one row for each set, set of strokes and variant. Variants without a warp have empty cells.
std::string warps_csv(const WarpsOptions& options, const WarpsResult& result);

// CSV: the distance between the results of two sets of strokes, one row for each set, variant and pair.
std::string warp_sensitivity_csv(const WarpsOptions& options, const WarpsResult& result);

// A gnuplot script that draws the error of methods and dimensions, and over points and nodes, as SVG.
std::string warps_plot_script(const WarpsOptions& options, const WarpsResult& result);

}  // namespace remapc
