// Everything that the results of a conversion depend on, except the inputs. A later run compares it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

struct ConversionNote {
  std::string source, target;  // models
  std::string hash;            // of all, with the numbers that the converter gives
  // The differences that a message shows: converter, options, version.
  std::vector<std::pair<std::string, std::string>> details;
};

// The hash holds what the converter makes of texels all over its domain: its numbers and its code. `ids`: of
// its steps; empty for assets. `options`: those that the results depend on.
ConversionNote conversion_note(const std::string& source, const std::string& target, const std::string& ids,
                               const Converter& converter, const std::string& options);

}  // namespace remap
