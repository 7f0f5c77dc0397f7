// This file turns fits into C++: a generated header for each, and the data of all for texremap. The same fit
// gives the same bytes on every machine.
#pragma once

#include <string>
#include <vector>

#include "converter/converter_data.hpp"
#include "lower/any_fit.hpp"
#include "lower/fit.hpp"

namespace remap {

// Returns the generated header `<id>.hpp`. Throws kNumeric for a fit without a converter and if a number is
// not finite as a float.
std::string emit_header(const Fit& fit);

// Return the generated headers of converters of whole materials. A warp has the specular workflow on both
// sides. Both functions throw kInput if require_valid() does.
std::string emit_header(const WorkflowFit& fit);
std::string emit_header(const WarpMapFit& fit);

// An EmittedFile is the text of a file that is made from fits.
struct EmittedFile {
  std::string name;  // within the folder of results
  std::string text;
};

// Returns the files that are made from all fits together, in the order of their ids. `converters.json` is the
// data of texremap. The converters between models of the hub, and of exponents, are written in each language
// (`languages/converters.h`, ...). Throws kNumeric for a fit without a converter.
std::vector<EmittedFile> emit_shared_files(std::vector<Fit> fits);

}  // namespace remap
