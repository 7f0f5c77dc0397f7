// The target's picture and how it changes with each parameter, at any parameters: what a non-linear match
// asks for. From the bank where the target has one, else from renders.
#pragma once

#include <string>
#include <vector>

#include "match/target_bank.hpp"

namespace remapc {

// One parameter that a match turns: alpha, canonical specular, diffuse, then others by name.
struct Coordinate {
  std::string name;     // of others
  remap::Range range;   // that `at` answers for; a single value where the target has no such parameter
  bool shared = false;  // one value for all color channels
};

inline constexpr std::size_t kAlphaCoordinate = 0, kSpecularCoordinate = 1, kDiffuseCoordinate = 2;

// A picture and its derivatives, one for each coordinate; floats as PictureTaker::take gives them.
struct PictureTangents {
  std::vector<float> picture;
  std::vector<std::vector<float>> by;  // empty where not asked for
};

class TargetPictures {
 public:
  virtual ~TargetPictures() = default;

  const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  double value(const RoleValues& point, std::size_t coordinate) const;
  void set_value(RoleValues* point, std::size_t coordinate, double value) const;

  // `wanted`: by which coordinates it is differentiated. Safe from many threads.
  virtual PictureTangents at(const RoleValues& point, const std::vector<bool>& wanted) const = 0;

 protected:
  // Width, specular and diffuse of `target`, and those of its parameters that `others` names.
  TargetPictures(const ProbedModel& target, const remap::Range& alphas,
                 const std::vector<std::string>& others);

 private:
  std::vector<Coordinate> coordinates_;
};

// Pictures of a target to whose specular diffuse adds (probe_diffuse), interpolated between the nodes of the
// bank: no renders but those of the bank and two for the diffuse picture.
class BankPictures final : public TargetPictures {
 public:
  BankPictures(const PictureTaker& picture_taker, const ProbedModel& target, const TargetBank& bank);

  PictureTangents at(const RoleValues& point, const std::vector<bool>& wanted) const override;

 private:
  const TargetBank& bank_;
  std::vector<float> diffuse_;  // what diffuse 1 adds
};

// Pictures of any target, rendered, with derivatives by central differences (one-sided at the ends of a
// range): two renders a coordinate and one for the point. `others`: parameters of no role that the match
// turns.
class RenderedPictures final : public TargetPictures {
 public:
  RenderedPictures(const PictureTaker& picture_taker, const ProbedModel& target, const remap::Range& alphas,
                   const std::vector<std::string>& others = {});

  PictureTangents at(const RoleValues& point, const std::vector<bool>& wanted) const override;

 private:
  const PictureTaker& picture_taker_;
  ProbedModel target_;
};

}  // namespace remapc
