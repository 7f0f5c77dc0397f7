// This file decides how reliable each converter of a folder is, from the pictures that its table compares,
// and writes the page that shows it.
#pragma once

#include <string>
#include <vector>

#include "build/fit_folder.hpp"
#include "emit/emit.hpp"
#include "lower/fit.hpp"

namespace remap {

// If the image error is larger, more than a third of the picture is wrong, and the models differ too much for
// any converter.
inline constexpr double kLargestTrustedError = 1.0 / 3.0;

// Returns true if the table of the fit compares spheres.
bool is_measured(const Fit& fit);

// Returns the RMS image error at the best parameters. If no pictures were compared, it is infinite.
double image_error(const Fit& fit);

// Returns why the user should check the converter first: `image error above 0.33` or `pictures never
// compared`. Returns an empty text if there is no reason. The report marks such converters.
std::string trust_warning(const Fit& fit);

// Returns the fits sorted by image error, smallest first. Fits with equal errors are sorted by id.
std::vector<const Fit*> by_trust(const std::vector<Fit>& fits);

inline constexpr const char* kReportName = "README.md";
inline constexpr const char* kFiguresName = "converters.csv";

// Returns the page in Markdown, and the table of all figures. Equal fits give equal bytes on every machine.
std::vector<EmittedFile> report(const FitFolder& folder);

// Returns all figures for spreadsheets and scripts, as CSV (RFC 4180): a header row, then one row for each
// converter. Converters of width and specular come first, by rising image error, then converters between
// workflows, then warps. Errors are fractions. Domains are alpha and specular. Unknown figures are empty.
std::string converters_csv(const FitFolder& folder);

}  // namespace remap
