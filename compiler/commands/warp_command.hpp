// The options of `remapc warp`, and what its two modes share: fitting a converter of texture sets, and
// copying texels of tables.
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

// The stroke pairs of all options, at least one. Throws kUsage if there are none, and as the readers of
// strokes do.
std::vector<StrokePair> strokes_of(const WarpCommand& command, const MapFrame& source,
                                   const MapFrame& target);

WarpOptions options_of(const WarpCommand& command, AppearanceDistance usual);

nlohmann::ordered_json report_of(const WarpDiagnostics& found);

// The diagnostics as text for people.
std::string summary_of(const WarpDiagnostics& found);

// Warps a pair of which at least one is a table (measured BRDFs or profiles). Tables have no parameters to
// fit, so texels are copied.
void warp_tables(const WarpCommand& command);

}  // namespace remapc
