#include "core/nearest_name.hpp"

#include <algorithm>
#include <utility>

namespace remap {
namespace {

// Only so many letters are compared, because nobody mistypes more letters.
constexpr std::size_t kLettersCompared = 200;

std::size_t edit_distance(std::string_view a, std::string_view b) {
  a = a.substr(0, kLettersCompared);
  b = b.substr(0, kLettersCompared);
  std::vector<std::vector<std::size_t>> distance(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) distance[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) distance[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      std::size_t best =
          std::min({distance[i - 1][j] + 1, distance[i][j - 1] + 1, distance[i - 1][j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) best = std::min(best, distance[i - 2][j - 2] + 1);
      distance[i][j] = best;
    }
  }
  return distance[a.size()][b.size()];
}

// Returns true if at most a third of the letters are wrong. Nobody mistypes more.
bool is_near(std::size_t distance, std::string_view name, std::string_view candidate) {
  return 3 * distance <= std::max(name.size(), candidate.size());
}

// Returns true if `name` is at least the first half of the candidate, such as --out of --output.
bool is_beginning(std::string_view name, std::string_view candidate) {
  return name.size() >= 3 && candidate.starts_with(name) && 2 * name.size() >= candidate.size();
}

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  std::string nearest;
  std::size_t smallest = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = is_beginning(name, candidate) ? 1 : edit_distance(name, candidate);
    if (!is_near(distance, name, candidate)) continue;
    if (nearest.empty() || distance < smallest) {
      nearest = candidate;
      smallest = distance;
    }
  }
  return nearest;
}

std::string closest_name(std::string_view name, std::span<const std::string> candidates) {
  const auto nearer = [name](const std::string& a, const std::string& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  };
  return *std::min_element(candidates.begin(), candidates.end(), nearer);
}

// If one name contains the other, treat them as so many typing errors apart.
constexpr std::size_t kPartDistance = 3;

std::vector<std::string> nearest_names(std::string_view name, std::vector<std::string> candidates,
                                       std::size_t count) {
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    const bool is_whole = candidate.find(name) != std::string::npos;  // such as ggx in mitsuba/ggx
    const bool is_part = name.find(candidate) != std::string::npos;
    if (is_whole || is_part || is_near(distance, name, candidate))
      ranked.emplace_back(is_whole  ? 0
                          : is_part ? std::min(distance, kPartDistance)
                                    : distance,
                          std::move(candidate));
  }
  std::ranges::stable_sort(ranked, {}, &std::pair<std::size_t, std::string>::first);
  ranked.resize(std::min(ranked.size(), count));
  std::vector<std::string> nearest;
  for (auto& [distance, name_of_rank] : ranked) nearest.push_back(std::move(name_of_rank));
  return nearest;
}

std::string joined(std::span<const std::string> names, std::string_view between) {
  std::string text;
  for (const std::string& name : names) (text += text.empty() ? "" : between) += name;
  return text;
}

std::string suggestion(std::string_view name, std::span<const std::string> candidates) {
  if (const std::string nearest = nearest_name(name, candidates); !nearest.empty())
    return " (did you mean " + nearest + "?)";
  if (candidates.empty()) return "";
  return " (choose " + joined(candidates, ", ") + ")";
}

}  // namespace remap
