// The simplex search of Nelder and Mead (1965) with the coefficients of Lagarias et al. 1998.
#pragma once

#include <functional>
#include <vector>

namespace remapc {

// Returns the best of at most `evaluations` points. The initial simplex is `start` and one of `steps` along
// each axis.
std::vector<double> simplex_search(const std::vector<double>& start, const std::vector<double>& steps,
                                   int evaluations,
                                   const std::function<double(const std::vector<double>&)>& energy);

}  // namespace remapc
