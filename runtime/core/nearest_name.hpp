// This file suggests corrections for mistyped names, such as models, converter ids and options.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// Returns the candidate with the smallest Damerau-Levenshtein distance to `name` (optimal string alignment),
// or an empty string if none is close. A candidate is close if at most a third of the letters of the longer
// name are wrong. A beginning such as --out is treated as one wrong letter if it is at least half of the
// candidate.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

// Returns the candidate with the smallest distance to `name`, even if it is not close. If several have this
// distance, returns the first. `candidates` must not be empty.
std::string closest_name(std::string_view name, std::span<const std::string> candidates);

// Returns up to `count` close candidates. Candidates that contain `name`, or that `name` contains, come
// first. The others follow in the order of their distance.
std::vector<std::string> nearest_names(std::string_view name, std::vector<std::string> candidates,
                                       std::size_t count);

// Returns `names` in one line, with `between` between two names.
std::string joined(std::span<const std::string> names, std::string_view between);

// Returns the end of a message: ` (did you mean X?)` if a name is close, otherwise ` (choose A, B, C)`.
// Returns an empty text without candidates.
std::string suggestion(std::string_view name, std::span<const std::string> candidates);

}  // namespace remap
