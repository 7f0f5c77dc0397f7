// The table by which fits are compared, as people read it and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/fit.hpp"

namespace remapc {

// One line a candidate under a line of headings; `-` for a figure that was not made or is 0. A column without
// any figure is left out. `specular`: what the target calls it.
std::string candidate_text(const std::vector<remap::Candidate>& candidates, const std::string& specular);

nlohmann::ordered_json candidate_json(const remap::Candidate& candidate);

// `on 144 rows held out: alpha rms 7.2e-04 max 1.5e-03, f0 rms ...`; `errors unknown` without such rows.
// `rows`: what they are.
std::string errors_text(const remap::Fit& fit, const std::string& rows);

nlohmann::ordered_json figures_json(const remap::ErrorFigures& figures);

}  // namespace remapc
