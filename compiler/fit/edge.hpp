// The behavior of a mapping at the edge of its domain and beyond (Sztrajman et al. 2019, figure 19: the
// chroma of a regressor shifts where specular leaves the table).
#pragma once

#include <vector>

#include "lower/fit.hpp"
#include "table/table.hpp"

namespace remap {

// Splits a table into its outermost rows and the others. Outermost are the lowest and the highest thirtieth
// of the distinct alpha1 and the highest thirtieth of the distinct specular1, at least one value each.
// Specular is only split if it has 4 or more distinct values. `outer` is empty if the inner rows could not be
// fitted (fewer than 6 alpha1).
struct EdgeRows {
  std::vector<TableRow> inner;
  std::vector<TableRow> outer;
};
EdgeRows edge_rows(const std::vector<TableRow>& rows);

// The bounding box of rows. Specular starts at 0.
Domain covered_domain(const std::vector<TableRow>& rows);

// Errors in alpha2 and specular2 on rows outside `domain`.
struct EdgeErrors {
  double alpha_rms = 0.0, specular_rms = 0.0;          // with the domain rule of generated code (fit.hpp)
  double raw_alpha_rms = 0.0, raw_specular_rms = 0.0;  // without the domain rule
};
EdgeErrors edge_errors(const MappingKind& mapping, const Domain& domain, const std::vector<TableRow>& rows);

// The largest specular that look_beyond() evaluates, relative to the largest specular of the domain.
inline constexpr double kBeyond = 1.5;

// `chroma_shift`: colors whose largest channel is the largest specular of the domain and whose other channels
// are 0.1, 0.5 and 1 times it, and the same colors times kBeyond, are mapped channel by channel without the
// domain rule, at 33 alphas over the domain. The shift is the largest difference between the two in a
// chromaticity coordinate (channel / sum of the channels). It is 0 for a proportional mapping. `fault` states
// where inside the domain alpha2 or specular2 is not finite or negative; empty if nowhere. Beyond it no code
// evaluates the mapping without the rule.
struct BeyondDomain {
  double chroma_shift = 0.0;
  std::string fault;
};
BeyondDomain look_beyond(const MappingKind& mapping, const Domain& domain);

}  // namespace remap
