// This file gives pictures of the target at any point, with derivatives by each parameter, for a non-linear
// match. They are interpolated in the bank if the target has one, and otherwise rendered.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "measure/target_bank.hpp"

namespace remap {

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
