// This file plots a table and its fits. A plot shows both target parameters, with the curves and errors of
// the fits.
#pragma once

#include <filesystem>
#include <vector>

#include "lower/fit.hpp"
#include "table/table.hpp"

namespace remap {

// Checks that a result can be plotted, before a long computation. Throws kUsage if `path` does not end with
// .svg or .png, and kOutput if its folder cannot be created or gnuplot is missing.
void require_plot(const std::filesystem::path& path);

// Writes the plot as SVG or PNG. `fits` are one to six fits of `table` with the same domain. Draws at most
// 2000 usable rows. Throws kOutput if gnuplot fails or the file cannot be written.
void write_plot(const std::filesystem::path& path, const Table& table, const std::vector<Fit>& fits);

// Returns the kind and, if it has one, the form of a fit: for example `parametric paper`, `svr`.
std::string fit_label(const Fit& fit);

}  // namespace remap
