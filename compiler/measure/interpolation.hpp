// This file interpolates over neighbouring widths of the target bank.
#pragma once

#include <array>
#include <cstddef>

namespace remap {

// This many nodes of the bank are interpolated together. Twelve nodes that are 5 % apart leave an error of
// 1e-7 in alpha.
inline constexpr std::size_t kInterpolationNodes = 12;

// A LagrangeBasis is the Lagrange basis on `nodes` at `x`: values and first derivatives.
struct LagrangeBasis {
  using Values = std::array<double, kInterpolationNodes>;
  Values value{};
  Values derivative{};

  LagrangeBasis(const Values& nodes, double x) {
    for (std::size_t i = 0; i < kInterpolationNodes; ++i) {
      double product = 1.0, sum = 0.0;
      for (std::size_t j = 0; j < kInterpolationNodes; ++j) {
        if (j == i) continue;
        const double factor = (x - nodes[j]) / (nodes[i] - nodes[j]);
        sum = sum * factor + product / (nodes[i] - nodes[j]);  // product rule, with one factor after another
        product *= factor;
      }
      value[i] = product;
      derivative[i] = sum;
    }
  }
};

}  // namespace remap
