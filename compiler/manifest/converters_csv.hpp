// The table of all figures of all converters of a folder, for spreadsheets and scripts.
#pragma once

#include <string>

#include "manifest/fit_folder.hpp"
#include "manifest/lock.hpp"

namespace remapc {

// Returns CSV (RFC 4180): a header row, then one row for each converter. Converters of width and specular
// come first, by rising image error, then those between workflows, then warps. Errors are shares, lengths of
// the domain are alpha and specular; unknown figures are empty. `lock` holds the bounds of lowering.
std::string converters_csv(const FitFolder& folder, const Lock& lock);

}  // namespace remapc
