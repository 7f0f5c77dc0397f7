// From a fit to C++: the generated header of one fit, and the data of all for texremap. Pure: the same fit
// and options give the same bytes on every machine.
#pragma once

#include <string>
#include <vector>

#include "converter_data/converter_data.hpp"
#include "lower/lower.hpp"
#include "remap/any_fit.hpp"
#include "remap/fit.hpp"

namespace remapc {

// The generated header `<id>.hpp`. Throws kNumeric where a number is not finite as a float or the mapping
// cannot be lowered within the tolerance, kInput where a specular parameter has a name that the header uses
// itself.
std::string emit_header(const remap::Fit& fit, const remap::LoweringOptions& options = {});

// The same header from polynomials to which fit.mapping was lowered already.
std::string emit_lowered_header(const remap::Fit& fit, const remap::Lowered& lowered);

// The generated headers of converters of whole materials; a warp has the specular workflow on both sides.
// Throw kInput for what require_valid() refuses.
std::string emit_header(const remap::WorkflowFit& fit);
std::string emit_header(const remap::WarpMapFit& fit);

// `converters.json`: what texremap needs of these converters, in the order of their ids.
inline constexpr const char* kConverterListName = "converters.json";
std::string emit_converter_list(std::vector<remap::ConverterData> converters);

}  // namespace remapc
