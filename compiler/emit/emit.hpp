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

// What is made of all fits together, in the order of their ids: `converters.json`, the data of texremap; and
// the converters between models of the hub, and of exponents, in each language (`languages/converters.h`,
// ...). Throws kNumeric for a fit without a converter.
struct EmittedFile {
  std::string name;  // within the folder of headers
  std::string text;
};
std::vector<EmittedFile> emit_shared_files(std::vector<Fit> fits);

}  // namespace remap
