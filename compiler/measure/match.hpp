// The match finds the width and specular of the target that give the picture of the source. At each width the
// loss is a polynomial in the coordinate of the target's family, so its minimum over specular is found
// exactly. The width is found by a search over the bank, then as the root of the derivative.
#pragma once

#include <map>
#include <vector>

#include "measure/polynomial.hpp"
#include "measure/target_bank.hpp"
#include "table/table.hpp"

namespace remap {

struct Match {
  double alpha = 0.0;
  double specular = 0.0;
  double error = 0.0;  // relative RMS of the picture: sqrt(loss / weighted source power)
  RowStatus status = RowStatus::kOk;
};

// Matches source materials whose pictures share weights and are combinations of the same few pictures: source
// = sum of coefficient[k] * basis[k]. Inner products with the bank are computed once for each node instead of
// once for each material. Not thread-safe; its bank is.
class Matcher {
 public:
  // `basis`: at least one picture; `squared_weights`: w^2 for each of its pixels.
  Matcher(const TargetBank& bank, std::vector<std::vector<float>> basis, std::vector<float> squared_weights);

  // Finds the best match; kUnstable if another width or specular gives as good a picture. `minima` holds the
  // bank nodes to start from and receives those of the minima found; if it is empty, the whole bank is
  // searched. Materials of similar specular share their minima, so passing them on saves most of the search.
  Match match(const std::vector<double>& coefficients, std::vector<std::size_t>* minima);

 private:
  // A polynomial in the coordinate of the bank's family.
  using Polynomial = std::vector<double>;
  // Weighted inner products at one bank node: of the target's picture with itself, and with each basis
  // picture.
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
  std::vector<std::vector<double>> power_;  // inner products of the basis pictures
  std::map<std::size_t, Products> products_;
};

}  // namespace remap
