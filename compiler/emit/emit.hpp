// From a fit to C++: its generated header, and the data of all for texremap. Pure: the same fit
// gives the same bytes on every machine.
#pragma once

#include <string>
#include <vector>

#include "converter/converter_data.hpp"
#include "lower/any_fit.hpp"
#include "lower/fit.hpp"

namespace remap {

// The generated header `<id>.hpp`. Throws kNumeric for a fit without a converter and where a number is not
// finite as a float.
std::string emit_header(const Fit& fit);

// The generated headers of converters of whole materials; a warp has the specular workflow on both sides.
// Throw kInput for what require_valid() refuses.
std::string emit_header(const WorkflowFit& fit);
std::string emit_header(const WarpMapFit& fit);

// `converters.json`: the converters of these fits, in the order of their ids. Throws kNumeric for a fit
// without one.
inline constexpr const char* kConverterListName = "converters.json";
std::string emit_converter_list(const std::vector<Fit>& fits);

// The converter of `fit`. Throws kNumeric where it has none.
const ConverterData& require_converter(const Fit& fit);

}  // namespace remap
