// The match: which width and specular of the target give the picture of the source. At each width the loss is
// a polynomial in the coordinate of the target's family, whose least value over all speculars is found as
// such; width by a search over the bank and then the root of the derivative.
#pragma once

#include <map>
#include <vector>

#include "match/target_bank.hpp"
#include "probe/polynomial.hpp"
#include "table/table.hpp"

namespace remapc {

struct Match {
  double alpha = 0.0;
  double specular = 0.0;
  double error = 0.0;  // sqrt(loss / weighted source power): relative RMS of the picture
  RowStatus status = RowStatus::kOk;
};

// Matches source materials whose pictures share weights and are combinations of the same few pictures: source
// = sum of coefficient[k] * basis[k]. Inner products with the bank are computed once a node, not once a
// material. Not safe to share between threads; the bank behind it is.
class Matcher {
 public:
  // `basis`: at least one picture; `squared_weights`: w^2 of each pixel, as long as they are.
  Matcher(const TargetBank& bank, std::vector<std::vector<float>> basis, std::vector<float> squared_weights);

  // The status is kUnstable where another width or specular gives as good a picture. `minima`: nodes of the
  // bank to start from, and on return those of the minima found. Empty: the whole bank is searched. Materials
  // that differ little in specular share their minima, and most of the search with them.
  Match match(const std::vector<double>& coefficients, std::vector<std::size_t>* minima);

 private:
  // A polynomial in the coordinate of the bank's family.
  using Polynomial = std::vector<double>;
  // Weighted inner products at one bank node: of the target's picture with itself, and with each of the
  // basis.
  struct Products {
    Polynomial power;
    std::vector<Polynomial> cross;
  };

  const Products& products(std::size_t node);
  Polynomial loss(const Products& products, const std::vector<double>& coefficients) const;
  PolynomialMinimum least(const Polynomial& loss) const;
  double loss_at_node(std::size_t node, const std::vector<double>& coefficients);
  std::vector<std::size_t> coarse_minima(const std::vector<double>& coefficients);
  std::size_t descend(std::size_t node, const std::vector<double>& coefficients);
  Match refine(std::size_t node, const std::vector<double>& coefficients);
  Match match_at(double x, const Polynomial& loss, double power) const;
  double source_power(const std::vector<double>& coefficients) const;

  const TargetBank& bank_;
  std::vector<std::vector<float>> basis_;
  std::vector<float> weights_;
  std::vector<std::vector<float>> weighted_basis_;
  std::vector<std::vector<double>> power_;  // basis against basis
  std::map<std::size_t, Products> products_;
};

}  // namespace remapc
