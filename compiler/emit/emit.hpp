// From a fit to C++: the generated header of one fit, and the registry of all. Pure: the same fit gives the
// same bytes on every machine.
#pragma once

#include <string>
#include <vector>

#include "model/fit.hpp"

namespace remapc {

// The generated header `<id>.hpp`. Throws kNumeric where a coefficient is not finite as a float,
// kInput where a specular parameter has a name that the header uses itself.
std::string emit_header(const remap::Fit& fit);

// `registry.hpp` for headers of these fits, which stand beside it: one entry a converter, in the order of
// ids.
std::string emit_registry(std::vector<remap::Fit> fits);

// What a kind of mapping contributes to its header (one implementation a kind, chosen by std::visit).
struct MappingCode {
  std::string description;  // comment lines without `// `: how the mapping is computed, and how exactly
  std::string
      functions;  // in namespace detail: `target_alpha(float alpha)` and `specular_slope(float alpha)`
};
MappingCode mapping_code(const remap::Parametric& form, const remap::Domain& domain);

}  // namespace remapc
