// This file gives pictures of the target at any point, with derivatives by each parameter for a non-linear
// match. They are interpolated in a bank of pictures if the target has one, and otherwise rendered.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "measure/picture_taker.hpp"

namespace remap {

// This is the largest ratio of neighbouring widths. Interpolating the loss over twelve such widths leaves an
// error of 1e-7 in alpha.
inline constexpr double kBankRatio = 1.05;

// Returns the widths of `target` to search if the narrowest width of the source is `narrowest`. They begin at
// a quarter of `narrowest`, because widths of two built-in models never differ by more than a factor of 2.
Range searched_widths(const ModelDescription& target, double narrowest);

// A TargetBank has, at each width of a geometric grid, the few pictures whose combinations give all others of
// this width (SpecularFamily). A picture is rendered when a search needs it for the first time.
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

// A Coordinate is one parameter that a match varies: alpha, canonical specular, diffuse, then others by name.
struct Coordinate {
  std::string name;     // empty for alpha, specular and diffuse
  Range range;          // a single value if the target has no such parameter
  bool shared = false;  // true if all color channels have one value
};

inline constexpr std::size_t kAlphaCoordinate = 0, kSpecularCoordinate = 1, kDiffuseCoordinate = 2;

// A PictureTangents holds a picture and its derivatives by each coordinate, as floats from
// PictureTaker::take.
struct PictureTangents {
  std::vector<float> picture;
  std::vector<std::vector<float>> by;  // pictures that nobody requested are empty
};

class TargetPictures {
 public:
  virtual ~TargetPictures() = default;

  const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  double value(const RoleValues& point, std::size_t coordinate) const;
  void set_value(RoleValues* point, std::size_t coordinate, double value) const;

  // Returns one picture for each of `points`. It is faster if points of one width follow each other. `wanted`
  // selects the coordinates for derivatives. Thread-safe.
  virtual std::vector<PictureTangents> at(const std::vector<RoleValues>& points,
                                          const std::vector<bool>& wanted) const = 0;

 protected:
  // The coordinates are width, specular and diffuse of `target`, and its parameters named in `others`.
  TargetPictures(const ProbedModel& target, const Range& alphas, const std::vector<std::string>& others);

 private:
  std::vector<Coordinate> coordinates_;
};

// A BankPictures interpolates pictures between the nodes of the bank. Diffuse of the target must add to its
// specular (probe_diffuse). Besides the bank, it needs two renders for the diffuse picture.
class BankPictures final : public TargetPictures {
 public:
  BankPictures(const PictureTaker& picture_taker, const ProbedModel& target, const TargetBank& bank);

  std::vector<PictureTangents> at(const std::vector<RoleValues>& points,
                                  const std::vector<bool>& wanted) const override;

 private:
  void add_at_width(std::span<const RoleValues> points, const std::vector<bool>& wanted,
                    std::vector<PictureTangents>* results) const;

  const TargetBank& bank_;
  std::vector<float> diffuse_;  // light that diffuse 1 adds
};

// A RenderedPictures renders pictures of any target, with derivatives by central differences (one-sided at
// the ends of a range). It needs two renders for each coordinate and one for the point. `others` names the
// parameters without a role that the match varies.
class RenderedPictures final : public TargetPictures {
 public:
  RenderedPictures(const PictureTaker& picture_taker, const ProbedModel& target, const Range& alphas,
                   const std::vector<std::string>& others = {});

  std::vector<PictureTangents> at(const std::vector<RoleValues>& points,
                                  const std::vector<bool>& wanted) const override;

 private:
  PictureTangents at_point(const RoleValues& point, const std::vector<bool>& wanted) const;

  const PictureTaker& picture_taker_;
  ProbedModel target_;
};

// A MatchTarget is a target with the pictures that matches use.
struct MatchTarget : ProbedModel {
  std::unique_ptr<TargetBank> bank;          // null if the target has no family
  std::unique_ptr<TargetPictures> pictures;  // null if no match is non-linear
};

// Finds how the pictures of `target` depend on its parameters, by renders at the widths `probed`. Makes
// pictures for non-linear matches if the target has no family, or if matches are `with_diffuse`. `searched`
// holds the widths of the match. `others` is as in RenderedPictures. If it is not empty, there is no bank.
MatchTarget match_target(const PictureTaker& picture_taker, const ProbedModel& target, const Range& searched,
                         const Range& probed, bool with_diffuse, const std::vector<std::string>& others = {});

}  // namespace remap
