// The target's picture and how it changes with each parameter, at any parameters: what a non-linear match
// asks for. From the bank where the target is affine, from renders where it is not.
#pragma once

#include <vector>

#include "sweep/target_bank.hpp"

namespace remapc {

// A picture and its derivatives by alpha, by canonical specular and by diffuse; floats as
// Photographer::take gives them.
struct PictureTangents {
  std::vector<float> picture;
  std::vector<float> by_alpha;
  std::vector<float> by_specular;
  std::vector<float> by_diffuse;
};

class TargetPictures {
 public:
  virtual ~TargetPictures() = default;

  // Ranges that `at` answers for, canonical.
  virtual const remap::Range& alphas() const = 0;
  virtual const remap::Range& speculars() const = 0;
  virtual const remap::Range& diffuses() const = 0;

  // `with_diffuse` false leaves by_diffuse empty. Safe from many threads.
  virtual PictureTangents at(const Sitting& point, bool with_diffuse) const = 0;
};

// Pictures of a target that is affine in specular and to which diffuse adds (probe.hpp), interpolated between
// the nodes of the bank: no renders but those of the bank and one of the diffuse picture.
class BankPictures final : public TargetPictures {
 public:
  BankPictures(const Photographer& photographer, const Subject& target, const TargetBank& bank);

  const remap::Range& alphas() const override { return alphas_; }
  const remap::Range& speculars() const override { return speculars_; }
  const remap::Range& diffuses() const override { return diffuses_; }
  PictureTangents at(const Sitting& point, bool with_diffuse) const override;

 private:
  const TargetBank& bank_;
  bool black_base_;
  remap::Range alphas_, speculars_, diffuses_;
  std::vector<float> diffuse_;  // what diffuse 1 adds
};

// Pictures of any target, rendered, with derivatives by central differences (one-sided at the ends of a
// range): seven renders a point.
class RenderedPictures final : public TargetPictures {
 public:
  RenderedPictures(const Photographer& photographer, const Subject& target, const remap::Range& alphas);

  const remap::Range& alphas() const override { return alphas_; }
  const remap::Range& speculars() const override { return speculars_; }
  const remap::Range& diffuses() const override { return diffuses_; }
  PictureTangents at(const Sitting& point, bool with_diffuse) const override;

 private:
  const Photographer& photographer_;
  Subject target_;
  remap::Range alphas_, speculars_, diffuses_;
};

}  // namespace remapc
