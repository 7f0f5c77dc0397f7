// A search without derivatives over a few numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace remap {

// The simplex method of Nelder and Mead (1965) from `start`, whose other corners lie `step` of each number
// (or `step`, of 0) away. Returns the best point after `evaluations` of `f`, which must not be NaN.
template <typename Function>
std::vector<double> simplex_search(const std::vector<double>& start, double step, int evaluations,
                                   const Function& f) {
  struct Corner {
    std::vector<double> at;
    double value;
  };
  std::vector<Corner> corners = {{start, f(start)}};
  for (std::size_t i = 0; i < start.size(); ++i) {
    std::vector<double> at = start;
    at[i] += at[i] == 0.0 ? step : step * at[i];
    corners.push_back({at, f(at)});
  }
  int used = static_cast<int>(corners.size());
  const auto mixed = [](const std::vector<double>& a, const std::vector<double>& b, double share) {
    std::vector<double> at(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) at[i] = a[i] + share * (b[i] - a[i]);
    return at;
  };
  while (used < evaluations) {
    std::ranges::sort(corners, {}, &Corner::value);
    Corner& worst = corners.back();
    std::vector<double> middle(start.size(), 0.0);
    for (std::size_t k = 0; k + 1 < corners.size(); ++k)
      for (std::size_t i = 0; i < middle.size(); ++i)
        middle[i] += corners[k].at[i] / static_cast<double>(corners.size() - 1);
    const auto tried = [&](double share) {
      Corner corner{mixed(middle, worst.at, share), 0.0};
      corner.value = f(corner.at);
      ++used;
      return corner;
    };
    const Corner reflected = tried(-1.0);
    if (reflected.value < corners.front().value) {
      const Corner further = tried(-2.0);
      worst = further.value < reflected.value ? further : reflected;
    } else if (reflected.value < corners[corners.size() - 2].value) {
      worst = reflected;
    } else {
      const Corner nearer = tried(reflected.value < worst.value ? -0.5 : 0.5);
      if (nearer.value < std::min(reflected.value, worst.value)) {
        worst = nearer;
      } else {
        for (std::size_t k = 1; k < corners.size(); ++k) {
          corners[k].at = mixed(corners.front().at, corners[k].at, 0.5);
          corners[k].value = f(corners[k].at);
          ++used;
        }
      }
    }
  }
  return std::ranges::min_element(corners, {}, &Corner::value)->at;
}

}  // namespace remap
