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
  // If two notes differ, a message shows which of these differ: converter, options, version.
  std::vector<std::pair<std::string, std::string>> details;
};

// Makes a note. Its hash covers the converter's results for texels all over its domain, so it notices changed
// numbers and changed code. `ids` are the ids of the steps, or empty for assets. `options` are the options
// that change results.
ConversionNote conversion_note(const std::string& source, const std::string& target, const std::string& ids,
                               const Converter& converter, const std::string& options);

}  // namespace remap
