// This file makes C++ from fits: a generated header for each fit, and the data of all fits for texremap.
// Equal fits give equal bytes on every machine.
#pragma once

#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "lower/fit_file.hpp"

namespace remap {

// Returns the generated header `<id>.hpp`. Throws kNumeric for a fit without a converter and if a number is
// not finite as a float.
std::string emit_header(const Fit& fit);

// Return the generated headers for converters of whole materials. A warp has the specular workflow on both
// sides. Both functions throw the errors of require_valid().
std::string emit_header(const WorkflowFit& fit);
std::string emit_header(const WarpMapFit& fit);

// An EmittedFile is made from all fits together.
struct EmittedFile {
  std::string name;  // path within the folder of headers
  std::string text;
};

// Returns the files that are made from all fits together, in the order of their ids. `converters.json` is the
// data of texremap. The converters between models of the hub, and of exponents, are written in each language
// (`languages/converters.h`, ...). Throws kNumeric for a fit without a converter.
std::vector<EmittedFile> emit_shared_files(std::vector<Fit> fits);

}  // namespace remap
