// One output of a mapping as a function that can be evaluated in doubles and enclosed over boxes, whatever
// kind it is of.
#pragma once

#include <functional>
#include <utility>

#include "lower/taylor.hpp"

namespace remap {

using AlphaTaylor = Taylor<1, 9>;  // of alpha alone
using TexelTaylor = Taylor<2, 7>;  // of alpha (variable 0) and specular (variable 1)

struct MappedFunction {
  bool of_specular = false;  // otherwise `specular` is not looked at
  std::function<double(double alpha, double specular)> value;
  std::function<AlphaTaylor(const AlphaTaylor& alpha)> over_alpha;
  std::function<TexelTaylor(const TexelTaylor& alpha, const TexelTaylor& specular)> over_both;
};

// `evaluate(alpha, specular)` must take any scalar of evaluate.hpp.
template <typename Evaluate>
MappedFunction mapped_function(bool of_specular, Evaluate evaluate) {
  return {of_specular, [evaluate](double alpha, double specular) { return evaluate(alpha, specular); },
          [evaluate](const AlphaTaylor& alpha) { return evaluate(alpha, AlphaTaylor(1.0)); },
          [evaluate](const TexelTaylor& alpha, const TexelTaylor& specular) {
            return evaluate(alpha, specular);
          }};
}

}  // namespace remap
