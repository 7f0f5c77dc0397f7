// This file holds the bank of target pictures. At each width of a geometric grid, the bank has the few
// pictures whose combinations give all others of this width (SpecularFamily). A picture is rendered when a
// search needs it for the first time.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <deque>
#include <mutex>
#include <span>
#include <vector>

#include "measure/picture_taker.hpp"

namespace remap {

// This is the largest ratio of neighbouring widths. Interpolating the loss over twelve such widths leaves an
// error of 1e-7 in alpha.
inline constexpr double kBankRatio = 1.05;

// Returns the widths of `target` to search if the narrowest width of the source is `narrowest`. They begin at
// a quarter of `narrowest`, because widths of two built-in models never differ by more than a factor of 2.
Range searched_widths(const ModelDescription& target, double narrowest);

class TargetBank {
 public:
  // Makes a bank for widths in `alphas`, clamped to the model's range. Neighbours are at most `ratio` apart,
  // and the last two at most 1.5 times as far. Widths are closer at the upper end, where interpolation has
  // nodes only on one side. `target` must have a family (ProbedModel::family).
  TargetBank(const PictureTaker& picture_taker, const ProbedModel& target, const Range& alphas, double ratio);

  std::size_t size() const { return alphas_.size(); }
  double alpha(std::size_t node) const { return alphas_[node]; }
  double log_step() const { return log_step_; }  // largest step in log(alpha)
  const SpecularFamily& family() const { return family_; }

  // Returns the pictures of a node (take_family). The first call renders and keeps them. Thread-safe.
  const std::vector<std::vector<float>>& pictures(std::size_t node) const;

  // Renders the `nodes` that no other thread has started. Threads that need the same nodes share the
  // work, and do not wait for each other at each node.
  void prepare(std::span<const std::size_t> nodes) const;

 private:
  const PictureTaker& picture_taker_;
  ProbedModel target_;
  SpecularFamily family_;
  double log_step_;
  std::vector<double> alphas_;
  // These have an element for each node.
  mutable std::deque<std::once_flag> are_rendered_;
  mutable std::deque<std::atomic<bool>> are_begun_;
  mutable std::vector<std::vector<std::vector<float>>> pictures_;
};

// A TargetGrid holds pictures of a target on a coarse grid of widths and speculars. If the target has no
// family (ProbedModel::family), they give a search its starting points.
class TargetGrid {
 public:
  // Samples widths in `alphas`, evenly in log(alpha), and canonical speculars, evenly. Diffuse is 0.
  TargetGrid(const PictureTaker& picture_taker, const ProbedModel& target, const Range& alphas);

  // Returns at most three grid points, the best first. At each of them, the weighted squared difference from
  // `source` is not larger than at its neighbours. The first call renders the pictures. Thread-safe.
  std::vector<RoleValues> minima(const std::vector<float>& source, const std::vector<float>& weights) const;

 private:
  const std::vector<float>& picture(std::size_t point) const;

  const PictureTaker& picture_taker_;
  ProbedModel target_;
  std::vector<RoleValues> points_;  // grouped by width
  mutable std::deque<std::once_flag> are_rendered_;
  mutable std::vector<std::vector<float>> pictures_;
};

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
