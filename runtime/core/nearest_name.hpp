// Suggestions for mistyped names, such as models, converter ids and options.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// Returns the candidate with the smallest Damerau-Levenshtein distance to `name` (optimal string alignment),
// or an empty string if none is close. A candidate is close if at most a third of the letters of the longer
// name are wrong. A beginning such as --out counts as one wrong letter, if it is at least half of the
// candidate.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

// The candidate with the smallest such distance, however large; the first of equals. `candidates` must not be
// empty.
std::string closest_name(std::string_view name, std::span<const std::string> candidates);

// Up to `count` near candidates: those that hold `name` or are held in it, then the others by that distance.
std::vector<std::string> nearest_names(std::string_view name, std::vector<std::string> candidates,
                                       std::size_t count);

// `names` in a line, with `between` between two.
std::string joined(std::span<const std::string> names, std::string_view between);

// The end of a message: ` (did you mean X?)` for a near name, else ` (choose A, B, C)`; empty without
// candidates.
std::string suggestion(std::string_view name, std::span<const std::string> candidates);

}  // namespace remap
