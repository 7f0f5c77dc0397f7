// The match: which width and specular of the target give the picture of the source. Specular in closed form
// for each width, width by a search over the bank and then the root of the derivative.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "sweep/target_bank.hpp"
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
  // `basis`: 1 or 2 pictures; `squared_weights`: w^2 of each pixel, as long as they are.
  Matcher(const TargetBank& bank, std::vector<std::vector<float>> basis, std::vector<float> squared_weights);

  // `minima`: nodes of the bank to start from, and on return those of the minima found. Empty: the whole bank
  // is searched. Materials that differ little in specular share their minima, and most of the search with
  // them.
  Match match(const std::vector<double>& coefficients, std::vector<std::size_t>* minima);

 private:
  // Weighted inner products of one bank node: base (a), slope (b) and the basis (x).
  struct Products {
    double aa = 0.0, ab = 0.0, bb = 0.0;
    std::array<double, 2> xa{}, xb{};
  };
  // The loss of one source material at one width as a quadratic in specular: c0 - 2 c1 s + c2 s^2.
  struct Quadratic {
    double c0 = 0.0, c1 = 0.0, c2 = 0.0;
  };
  struct Optimum {
    double specular = 0.0;
    double loss = 0.0;
  };

  const Products& products(std::size_t node);
  Quadratic quadratic(const Products& p, const std::vector<double>& coefficients) const;
  Optimum optimum(const Quadratic& q) const;
  double loss_at_node(std::size_t node, const std::vector<double>& coefficients);
  std::vector<std::size_t> coarse_minima(const std::vector<double>& coefficients);
  std::size_t descend(std::size_t node, const std::vector<double>& coefficients);
  Match refine(std::size_t node, const std::vector<double>& coefficients);
  double source_power(const std::vector<double>& coefficients) const;

  const TargetBank& bank_;
  std::vector<std::vector<float>> basis_;
  std::vector<float> weights_;
  std::vector<std::vector<float>> weighted_basis_;
  std::array<std::array<double, 2>, 2> power_{};  // basis against basis
  std::map<std::size_t, Products> products_;
};

}  // namespace remapc
