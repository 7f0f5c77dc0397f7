// `remapc warp` as it was asked for, and what both ways of carrying it out share: a fit of parameters, and
// the copy of texels.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "warp/warp.hpp"

namespace remapc {

struct WarpCommand {
  std::string source, target;
  std::string source_model = "mitsuba/ggx", target_model = "mitsuba/ggx";
  std::vector<std::string> masks, boxes, paintings;  // source, template, source, template ...
  std::string method = "registration";
  std::string distance;  // empty: relative, plain where both are profiles
  int dimensions = 0;
  bool exact = false;
  std::filesystem::path output, copy, report;
  bool json = false;
};

// At least one pair. Throws as the readers of strokes do.
std::vector<StrokePair> strokes_of(const WarpCommand& command, const MapFrame& source,
                                   const MapFrame& target);

WarpOptions options_of(const WarpCommand& command, AppearanceDistance usual);

nlohmann::ordered_json report_of(const WarpDiagnostics& found);

// What the diagnostics say, in words.
std::string summary_of(const WarpDiagnostics& found);

// A pair of which one at least is a table: measured BRDFs or profiles. There is nothing to fit, texels are
// copied.
void warp_tables(const WarpCommand& command);

}  // namespace remapc
