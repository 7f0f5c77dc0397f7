// This file prints a comparison of fits, as a text table and as JSON.
#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"
#include "lower/fit_fields.hpp"

namespace remap {

// Returns one line per candidate below a line of headings. `-` means that a figure is 0 or was not measured.
// Columns without figures are left out. `specular` is the name of the target's specular parameter.
std::string candidate_text(const std::vector<CandidateRecord>& candidates, const std::string& specular);

Json candidate_json(const CandidateRecord& candidate);

// Returns `on 144 rows held out: alpha rms 7.2e-04 max 1.5e-03, f0 rms ...`, or `errors unknown` if no rows
// were held out. `rows` describes the rows, such as `held out`.
std::string errors_text(const Fit& fit, const std::string& rows);

}  // namespace remap
