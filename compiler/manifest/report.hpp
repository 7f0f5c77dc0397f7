// Writes the page that says how far each converter of a folder can be trusted.
#pragma once

#include <string>
#include <vector>

#include "manifest/fit_folder.hpp"
#include "manifest/lock.hpp"

namespace remapc {

inline constexpr const char* kReportName = "README.md";
inline constexpr const char* kFiguresName = "converters.csv";
inline constexpr const char* kPlotName = "pairs.svg";

struct ReportFile {
  std::string name;  // in the folder of fits
  std::string text;
};

// Returns the page in Markdown, the table of all figures and the plot. `lock` holds the bounds of lowering.
// The same fits give the same bytes on every machine.
std::vector<ReportFile> report(const FitFolder& folder, const Lock& lock);

}  // namespace remapc
