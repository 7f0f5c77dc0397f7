// Suggestions for mistyped names, such as models, converter ids and options.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace remap {

// The candidate with the smallest Damerau-Levenshtein distance to `name` (optimal string alignment), or an
// empty string where none is within half of the longer name.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

// The candidate with the smallest such distance, however large; the first of equals. `candidates` must not be
// empty.
std::string closest_name(std::string_view name, std::span<const std::string> candidates);

// The end of a message: ` (did you mean X?)` for a near name, else ` (choose A, B, C)`; empty without
// candidates.
std::string suggestion(std::string_view name, std::span<const std::string> candidates);

}  // namespace remap
