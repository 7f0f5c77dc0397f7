// What the study of warps found, as a table in words, CSV, a plot and pictures.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/image.hpp"
#include "study/warps.hpp"

namespace remapc {

// Means over sets and strokes, a line a variant.
std::string warps_text(const WarpsOptions& options, const WarpsResult& result);

// CSV: a row for each set, set of strokes and variant. Figures of warps are empty where there is none.
std::string warps_csv(const WarpsOptions& options, const WarpsResult& result);

// CSV: how far the results of two sets of strokes are apart, a row for each set, variant and pair.
std::string warp_sensitivity_csv(const WarpsOptions& options, const WarpsResult& result);

// A script for gnuplot: error of methods and dimensions for each set, and over points and nodes, as SVG.
std::string warps_plot_script(const WarpsOptions& options, const WarpsResult& result);

}  // namespace remapc
