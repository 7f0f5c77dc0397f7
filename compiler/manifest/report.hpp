// The page that says how far each converter of a folder can be trusted.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "manifest/fit_folder.hpp"
#include "manifest/lock.hpp"
#include "model/fit.hpp"

namespace remapc {

inline constexpr const char* kReportName = "README.md";
inline constexpr const char* kPlotName = "pairs.svg";

struct ReportFile {
  std::string name;  // in the folder of fits
  std::string text;
};

// The page in Markdown and the pictures that it shows. `lock`: for the bounds of lowering. The same fits give
// the same bytes on every machine.
std::vector<ReportFile> report(const FitFolder& folder, const Lock& lock);

// Whether the fit comes from a table that compares spheres.
bool is_measured(const remap::Fit& fit);

// Models with measured converters to or from more than one other; also two that have but each other. The rest
// hang on one of these.
std::set<std::string> hub_models(const std::vector<remap::Fit>& fits);

// Small multiples of the measured pairs in SVG: target alpha over source alpha, and the ratio of speculars,
// at specular 0.5 or the edge of the domain below it. One row a source, one column a target for the hub; then
// the pairs of other models.
std::string pairs_plot(const std::vector<remap::Fit>& fits);

}  // namespace remapc
