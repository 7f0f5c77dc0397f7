// The comparison of fits, as a text table and as JSON.
#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"
#include "lower/fit_fields.hpp"

namespace remap {

// One line per candidate below a line of headings. `-` stands for a figure that is 0 or was not measured;
// columns without figures are left out. `specular`: the name of the target's specular parameter.
std::string candidate_text(const std::vector<CandidateRecord>& candidates, const std::string& specular);

Json candidate_json(const CandidateRecord& candidate);

// `on 144 rows held out: alpha rms 7.2e-04 max 1.5e-03, f0 rms ...`, or `errors unknown` where no rows were
// held out. `rows`: describes the rows, as `held out`.
std::string errors_text(const Fit& fit, const std::string& rows);

}  // namespace remap
