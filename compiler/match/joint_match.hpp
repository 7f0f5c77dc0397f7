// The joint match: all parameters of the target that are free at once, by bounded non-linear least squares
// over the whole picture (Sztrajman et al. 2019, sections 3.1 and 4.1: one and three stages), over all its
// color channels together where it has more than one: width and whatever else has no color is common to
// them, the rest is each channel's own. Also matches targets that are not affine in specular. The sweep meets
// Ceres here only.
#pragma once

#include <span>
#include <vector>

#include "match/target_pictures.hpp"
#include "table/table.hpp"

namespace remapc {

// Where a one-stage match starts, as shares of the target's ranges of alpha, specular and diffuse.
inline const RoleValues kFixedGuess{0.5, 0.5, 0.5};

struct JointOptions {
  bool free_diffuse = true;        // false: diffuse stays as the guess has it
  bool source_has_diffuse = true;  // false: diffuse 0 is the answer, and no bound that was hit
};

// One color channel of the source: its picture, and w^2 of each pixel.
struct JointChannel {
  std::vector<float> picture, weights;
};

struct JointMatch {
  std::vector<RoleValues> points;  // canonical; one a channel
  double error = 0.0;              // relative RMS of the picture, weighted, all channels
  bool converged = false;
  RowStatus status = RowStatus::kOk;

  const RoleValues& point() const { return points.front(); }  // of a grey match
};

class JointMatcher {
 public:
  // Pictures are as long as the target's, which must outlive the matcher.
  JointMatcher(const TargetPictures& target, std::vector<JointChannel> channels, const JointOptions& options);

  // A grey match.
  JointMatcher(const TargetPictures& target, std::vector<float> source, std::vector<float> squared_weights,
               const JointOptions& options);

  // What a trust-region search from `guess`, of every channel, finds (Levenberg and Marquardt with bounds,
  // Ceres). kUnstable where it does not converge, where a search from one of four other guesses ends with an
  // error lower by more than 1 %, or with one within 1 % and a parameter further away than 10 %; else
  // kClamped where a parameter lies at its bound and the pictures differ. A guess out of bounds is moved into
  // them. Throws kNumeric where Ceres fails.
  JointMatch match_from(const RoleValues& guess) const;

  // The best that searches from several guesses find; kUnstable where two of them rival as above.
  JointMatch best_match(const std::vector<RoleValues>& guesses) const;

  // Relative RMS, weighted, of `picture` against the source, of a grey match.
  double error_of(std::span<const float> picture) const;

  // The parameters that shares (0 to 1) of the target's ranges stand for. Parameters of no role that `shares`
  // does not name take the shares of alpha, specular and diffuse in turn.
  RoleValues point_of(const RoleValues& shares) const;

  // The guesses by which match_from judges, as shares: narrow and wide, weak and strong, bright and dark.
  static const std::vector<RoleValues>& other_guesses();

 private:
  // A number that is searched: a coordinate of one channel, or of all.
  struct Unknown {
    std::size_t coordinate;
    std::size_t channel;
    bool shared;

    bool concerns(std::size_t c) const { return shared || channel == c; }
  };
  class PictureCost;

  std::vector<Unknown> unknowns() const;
  std::vector<RoleValues> points_of(const double* values, const RoleValues& guess) const;
  JointMatch search(const RoleValues& guess, double tolerance) const;
  RowStatus judge(const JointMatch& match, const std::vector<JointMatch>& rivals) const;
  bool apart(const JointMatch& a, const JointMatch& b) const;
  bool at_bound(const JointMatch& match) const;

  const TargetPictures& target_;
  std::vector<JointChannel> channels_;
  JointOptions options_;
  std::vector<Unknown> unknowns_;
  std::vector<bool> wanted_;  // coordinates that are searched
  double power_ = 0.0;
};

}  // namespace remapc
