// This file writes the page that shows how reliable each converter of a folder is.
#pragma once

#include <string>
#include <vector>

#include "build/fit_folder.hpp"
#include "emit/emit.hpp"

namespace remap {

inline constexpr const char* kReportName = "README.md";
inline constexpr const char* kFiguresName = "converters.csv";

// Returns the page in Markdown, and the table of all figures. Equal fits give equal bytes on every machine.
std::vector<EmittedFile> report(const FitFolder& folder);

// Returns all figures for spreadsheets and scripts, as CSV (RFC 4180): a header row, then one row for each
// converter. Converters of width and specular come first, by rising image error, then converters between
// workflows, then warps. Errors are fractions. Domains are alpha and specular. Unknown figures are empty.
std::string converters_csv(const FitFolder& folder);

}  // namespace remap
