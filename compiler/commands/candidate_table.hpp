// The comparison of fits, as a text table and as JSON.
#pragma once

#include <string>
#include <vector>

#include "model/fit.hpp"
#include "text/json.hpp"

namespace remapc {

// One line per candidate below a line of headings. `-` stands for a figure that is 0 or was not measured;
// columns without figures are left out. `specular`: the name of the target's specular parameter.
std::string candidate_text(const std::vector<remap::Candidate>& candidates, const std::string& specular);

remap::Json candidate_json(const remap::Candidate& candidate);

// `on 144 rows held out: alpha rms 7.2e-04 max 1.5e-03, f0 rms ...`, or `errors unknown` where no rows were
// held out. `rows`: describes the rows, as `held out`.
std::string errors_text(const remap::Fit& fit, const std::string& rows);

remap::Json figures_json(const remap::ErrorFigures& figures);

}  // namespace remapc
