// How a mapping behaves at the edge of its domain and beyond it (Sztrajman et al. 2019, figure 19: the chroma
// of a regressor shifts where specular leaves the table).
#pragma once

#include <vector>

#include "model/fit.hpp"
#include "table/table.hpp"

namespace remapc {

// The outermost rows of a table, and those that are left: the lowest and the highest thirtieth of the
// different alpha1 and the highest thirtieth of the different specular1, at least one of each. `outer` is
// empty where the rows that are left could not be fitted (fewer than 6 alpha1); speculars are only left out
// where there are 4 or more.
struct EdgeRows {
  std::vector<TableRow> inner;
  std::vector<TableRow> outer;
};
EdgeRows edge_rows(const std::vector<TableRow>& rows);

// Errors in alpha2 and specular2 on rows outside `domain`.
struct EdgeErrors {
  double alpha_rms = 0.0, specular_rms = 0.0;          // with the domain rule of generated code (fit.hpp)
  double raw_alpha_rms = 0.0, raw_specular_rms = 0.0;  // the mapping as it stands
};
EdgeErrors edge_errors(const remap::MappingKind& mapping, const remap::Domain& domain,
                       const std::vector<TableRow>& rows);

// How far beyond the largest specular of the domain a mapping is looked at.
inline constexpr double kBeyond = 1.5;

// Chroma shift: colors whose largest channel is the largest specular of the domain and whose others are 0.1,
// 0.5 and 1 of it, and the same times kBeyond, are mapped channel by channel without the domain rule, at 33
// alphas over the domain. The largest difference between the two in a chromaticity coordinate, channel / sum
// of the channels. 0 for a proportional mapping.
// `fault` says where alpha2 or specular2 is not finite or negative on that way; empty where nowhere.
struct BeyondDomain {
  double chroma_shift = 0.0;
  std::string fault;
};
BeyondDomain look_beyond(const remap::MappingKind& mapping, const remap::Domain& domain);

}  // namespace remapc
