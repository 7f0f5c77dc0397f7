// This file records what results of a conversion depend on, except the inputs. A later run compares it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

struct ConversionNote {
  std::string source, target;  // names of models
  std::string hash;            // hash of everything, including the converter's results
  // These are the differences that a message shows: converter, options, version.
  std::vector<std::pair<std::string, std::string>> details;
};

// Makes a note. The hash holds the converter's results for texels all over its domain, so it covers numbers
// and code. `ids` are its steps, or empty for assets. `options` are the ones that the results depend on.
ConversionNote conversion_note(const std::string& source, const std::string& target, const std::string& ids,
                               const Converter& converter, const std::string& options);

}  // namespace remap
