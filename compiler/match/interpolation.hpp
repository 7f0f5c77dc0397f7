// Interpolation over neighbouring widths of the target bank.
#pragma once

#include <array>
#include <cstddef>

namespace remapc {

// Nodes of the bank that one interpolation uses: twelve nodes 5 % apart leave 1e-7 of alpha.
inline constexpr std::size_t kInterpolationNodes = 12;

// Lagrange basis on `nodes` at `x`: values and first derivatives.
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
        sum = sum * factor + product / (nodes[i] - nodes[j]);  // product rule, one factor at a time
        product *= factor;
      }
      value[i] = product;
      derivative[i] = sum;
    }
  }
};

}  // namespace remapc
