#include "lower/covered_box.hpp"

#include <algorithm>

namespace remap {
namespace {

constexpr double kSpecularWeight = 0.25;

}  // namespace

std::optional<Domain> covered_box(const std::vector<CoveredColumn>& columns) {
  std::optional<Domain> best;
  double best_score = -1.0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].is_gap) continue;
    double reach = INFINITY;
    for (std::size_t j = i; j < columns.size(); ++j) {
      if (columns[j].is_gap) continue;
      reach = std::min(reach, columns[j].reach);
      if (!(reach > 0.0)) break;
      const double score = (columns[j].last - columns[i].first) * std::pow(reach, kSpecularWeight);
      if (!(score > best_score)) continue;
      best_score = score;
      best = Domain{{columns[i].first, columns[j].last}, {0.0, reach}};
    }
  }
  return best;
}

}  // namespace remap
