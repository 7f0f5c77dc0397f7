// The joint match: alpha, specular and diffuse of the target at once, by bounded non-linear least squares
// over the whole picture (Sztrajman et al. 2019, sections 3.1 and 4.1: one and three stages). Also matches
// targets that are not affine in specular. The sweep meets Ceres here only.
#pragma once

#include <span>
#include <vector>

#include "sweep/target_pictures.hpp"
#include "table/table.hpp"

namespace remapc {

// Where a one-stage match starts, as shares of the target's ranges of alpha, specular and diffuse.
inline constexpr Sitting kFixedGuess{0.5, 0.5, 0.5};

struct JointOptions {
  bool free_diffuse = true;        // false: diffuse stays as the guess has it
  bool source_has_diffuse = true;  // false: diffuse 0 is the answer, and no bound that was hit
};

struct JointMatch {
  Sitting point;       // canonical
  double error = 0.0;  // relative RMS of the picture, weighted
  bool converged = false;
  RowStatus status = RowStatus::kOk;
};

class JointMatcher {
 public:
  // `source` and `squared_weights`: as long as the target's pictures, which must outlive the matcher.
  JointMatcher(const TargetPictures& target, std::vector<float> source, std::vector<float> squared_weights,
               const JointOptions& options);

  // What a trust-region search from `guess` finds (Levenberg and Marquardt with bounds, Ceres). kUnstable
  // where it does not converge, where a search from one of four other guesses ends with an error lower by
  // more than 1 %, or with one within 1 % and a parameter further away than 10 %; else kClamped where a
  // parameter lies at its bound. A guess out of bounds is moved into them. Throws kNumeric where Ceres fails.
  JointMatch match_from(const Sitting& guess) const;

  // The best that searches from several guesses find; kUnstable where two of them rival as above.
  JointMatch best_match(const std::vector<Sitting>& guesses) const;

  // Relative RMS, weighted, of `picture` against the source.
  double error_of(std::span<const float> picture) const;

  // The parameters that shares (0 to 1) of the target's ranges stand for.
  Sitting point_of(const Sitting& shares) const;

 private:
  JointMatch search(const Sitting& guess, double tolerance) const;
  RowStatus judge(const JointMatch& match, const std::vector<JointMatch>& rivals) const;
  bool apart(const Sitting& a, const Sitting& b) const;
  bool at_bound(const Sitting& point) const;

  const TargetPictures& target_;
  std::vector<float> source_;
  std::vector<float> weights_;
  JointOptions options_;
  double power_;
};

}  // namespace remapc
