// This file finds the width and specular of the target that give the picture of the source. At each width,
// the loss is a polynomial in the coordinate of the target's family, so its minimum over specular is found
// exactly. The best width is first searched in the bank, and then found as the root of the derivative.
#pragma once

#include <map>
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

}  // namespace remap
