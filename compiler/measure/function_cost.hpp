// This file lets Ceres minimise the squares of a function's results.
#pragma once

#include <functional>
#include <utility>

#include <ceres/ceres.h>

namespace remap {

// A FunctionCost calls a function with the unknowns. It computes the residuals and, if `jacobian` is not
// null, a row of derivatives for each residual. It returns false if it cannot.
class FunctionCost final : public ceres::CostFunction {
 public:
  using Function = std::function<bool(const double* unknowns, double* residuals, double* jacobian)>;

  FunctionCost(std::size_t residuals, std::size_t unknowns, Function function)
      : function_(std::move(function)) {
    set_num_residuals(static_cast<int>(residuals));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(unknowns));
  }
  bool Evaluate(double const* const* unknowns, double* residuals, double** jacobians) const override {
    return function_(unknowns[0], residuals, jacobians == nullptr ? nullptr : jacobians[0]);
  }

 private:
  Function function_;
};

}  // namespace remap
