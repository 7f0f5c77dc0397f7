// This file finds the parameters of the target that give the picture of the source. Matcher finds width and
// specular. At each width, the loss is a polynomial in the coordinate of the target's family, so its minimum
// over specular is found exactly. The best width is first searched in the bank, and then found as the root of
// the derivative. JointMatcher (joint_match.cpp) varies all free parameters of the target at once. It uses
// bounded non-linear least squares over the whole picture (Sztrajman et al. 2019, sections 3.1 and 4.1: one
// and three stages). It is also used for targets that are not affine in specular. With several color
// channels, parameters without color (such as width) are shared, and each channel has its own values of the
// others. In a sweep, only this match uses Ceres.
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "measure/specular_response.hpp"
#include "measure/target_pictures.hpp"
#include "table/table.hpp"

namespace remap {

struct Match {
  std::vector<RoleValues> points;  // canonical, one for each channel
  double error = 0.0;              // as the objective defines it: weighted relative RMS over all channels
  double picture_error = 0.0;      // like `error`, but only over the pixels, without means
  RowStatus status = RowStatus::kOk;
  bool converged = true;

  const RoleValues& point() const { return points.front(); }  // for a grey match
};

// A Matcher matches source materials whose pictures share weights and are combinations of the same few
// pictures: source = sum of coefficient[k] * basis[k]. Inner products with the bank are computed once for
// each node instead of once for each material. A Matcher is not thread-safe, but its bank is.
class Matcher {
 public:
  // `basis` has at least one picture, of as many numbers as `weights`.
  Matcher(const TargetBank& bank, std::vector<std::vector<float>> basis, PictureWeights weights);

  // Finds the best match. It is kUnstable if another width or specular gives an equally good picture.
  // `minima` holds the bank nodes where the search starts, and receives the nodes of the minima that it
  // finds. If it is empty, the whole bank is searched. Materials with similar specular have the same minima,
  // so passing `minima` from one material to the next saves most of the search.
  Match match(const std::vector<double>& coefficients, std::vector<std::size_t>* minima);

 private:
  // A Polynomial is a polynomial in the coordinate of the bank's family.
  using Polynomial = std::vector<double>;
  // A Products holds weighted inner products at one bank node: of the target's picture with itself, and with
  // each basis picture, over all samples and over only the means.
  struct Products {
    Polynomial power, power_of_means;
    std::vector<Polynomial> cross, cross_of_means;
  };

  const Products& products(std::size_t node);
  static Polynomial loss(const Polynomial& power, const std::vector<Polynomial>& cross,
                         const std::vector<double>& coefficients);
  double best_coordinate(const Polynomial& loss) const;
  double loss_at_node(std::size_t node, const std::vector<double>& coefficients);
  std::vector<std::size_t> coarse_minima(const std::vector<double>& coefficients);
  std::size_t descend(std::size_t node, const std::vector<double>& coefficients);
  Match refine(std::size_t node, const std::vector<double>& coefficients);
  Match match_at(double x, const Polynomial& loss, const Polynomial& loss_of_means,
                 const std::vector<double>& coefficients) const;

  const TargetBank& bank_;
  std::vector<std::vector<float>> basis_;
  PictureWeights weights_;
  std::vector<std::vector<float>> weighted_basis_;
  // These are Gram matrices of the basis pictures, over all samples and over only the means.
  std::vector<std::vector<double>> power_, power_of_means_;
  std::map<std::size_t, Products> products_;
};

// This is the initial guess of a one-stage match, as fractions of the ranges of alpha, specular and diffuse.
inline const RoleValues kFixedGuess{0.5, 0.5, 0.5};

// A DiffuseSearch decides how a match treats the target's diffuse.
enum class DiffuseSearch {
  kNone,            // it keeps the value of the guess
  kFree,            // it is searched
  kOfBlackDiffuse,  // it is searched; 0 is an answer, not a bound that was hit, as the source has no diffuse
};

// A JointChannel is one color channel of the source.
struct JointChannel {
  std::vector<float> picture;
  PictureWeights weights;
  bool is_black() const { return remap::is_black(picture); }
};

class JointMatcher {
 public:
  // A grey match has one channel. The pictures of channels must be as long as the target's pictures. `target`
  // must outlive the matcher.
  JointMatcher(const TargetPictures& target, std::vector<JointChannel> channels, DiffuseSearch diffuse);

  // Returns the best match of searches from `guesses` in every channel, by Ceres' bounded
  // Levenberg-Marquardt. A guess out of bounds is moved into them. The status is kUnstable if the search does
  // not converge. It is also kUnstable if a search from another guess or from `rivals` ends with an error
  // lower by more than 1 %, or within 1 % but with a parameter that differs by more than 10 %. Otherwise it
  // is kClamped if a parameter is at a bound and the pictures differ. Throws kNumeric if Ceres fails.
  Match match(const std::vector<RoleValues>& guesses, const std::vector<RoleValues>& rivals = {}) const;

  // Returns the weighted relative RMS of the pixels of `pictures`, one per channel, against the source.
  double picture_error(std::span<const std::vector<float>> pictures) const;

  // Converts fractions (0 to 1) of the target's ranges to parameters. Parameters without a role get the
  // fractions of alpha, specular and diffuse, in turn.
  RoleValues point_of(const RoleValues& shares) const;

  // Returns four other starting points, which show whether a match is unique: narrow and wide, weak and
  // strong, bright and dark.
  std::vector<RoleValues> other_guesses() const;

 private:
  // An Unknown is one number that a search varies: a coordinate of one channel, or a coordinate that all
  // channels share.
  struct Unknown {
    std::size_t coordinate;
    std::size_t channel;
    bool shared;

    bool concerns(std::size_t c) const { return shared || channel == c; }
  };

  std::vector<Unknown> unknowns() const;
  std::vector<RoleValues> points_of(const double* values, const RoleValues& guess) const;
  std::vector<std::vector<double>> gram(const double* values, const RoleValues& guess) const;
  Match search(const RoleValues& guess, double tolerance) const;
  RowStatus judge(const Match& match, const std::vector<Match>& rivals) const;
  bool apart(const Match& a, const Match& b) const;
  bool at_bound(const Match& match) const;

  const TargetPictures& target_;
  std::vector<JointChannel> channels_;
  DiffuseSearch diffuse_;
  std::vector<Unknown> unknowns_;
  std::vector<bool> wanted_;  // coordinates that the search varies
  double power_ = 0.0;
};

}  // namespace remap
