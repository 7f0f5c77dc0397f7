// Suggestions for mistyped names: models, converter ids, options.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace remap {

// The candidate with the smallest Damerau-Levenshtein distance to `name` (optimal string alignment), or an
// empty string where none is within half of the longer name.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

// The candidate with the smallest such distance however far it is; the first of several. `candidates` is not
// empty.
std::string closest_name(std::string_view name, std::span<const std::string> candidates);

// `; did you mean X?` for a near name, else `; known: A, B, C`. Ready to append to a message.
std::string suggestion(std::string_view name, std::span<const std::string> candidates);

}  // namespace remap
