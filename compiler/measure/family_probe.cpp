#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "measure/objective.hpp"
#include "measure/picture_taker.hpp"
#include "measure/probe.hpp"
#include "measure/specular_response.hpp"

namespace remap {
namespace {

using Radiances = std::vector<float>;
using Matrix = std::vector<std::vector<double>>;

// This is the largest number of steps. It can check degrees up to half of it between their nodes.
constexpr std::size_t kFinest = 32;
constexpr std::size_t kLeastChecked = 8;

// Returns a Chebyshev point of the second kind in [-1, 1]. Polynomials through these points do not oscillate
// (Trefethen 2013, chapter 2). Every second point is also a point for half as many steps. The ends and the
// middle are exact.
double chebyshev_point(std::size_t index) {
  const double steps = 2.0 * static_cast<double>(index) - static_cast<double>(kFinest);
  return std::sin(std::numbers::pi * steps / (2.0 * static_cast<double>(kFinest)));
}

// Does one step of Gauss-Jordan elimination on normal equations. Afterwards row `pivot` holds the weights of
// this picture when all pivots so far fit the other pictures by least squares. Each diagonal entry that was
// not a pivot is the squared residual of its picture.
void eliminate(std::size_t pivot, Matrix* gram) {
  Matrix& g = *gram;
  const double scale = 1.0 / g[pivot][pivot];
  for (double& value : g[pivot]) value *= scale;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double factor = g[i][pivot];
    for (std::size_t j = 0; i != pivot && j < g.size(); ++j) g[i][j] -= factor * g[pivot][j];
  }
}

// A FamilyProbe renders a model at three widths, over one coordinate of specular.
class FamilyProbe {
 public:
  FamilyProbe(const PictureTaker& picture_taker, const ModelDescription& model, const Range& alphas,
              SpecularCoordinate coordinate)
      : picture_taker_(picture_taker),
        model_(model),
        axis_{model.parameter(ParameterRole::kSpecular).range, coordinate, {}, {}},
        // The widest comes first. Its highlight covers all angles, so it is the most likely to fail a check.
        alphas_{alphas.max, std::sqrt(alphas.min * alphas.max), alphas.min} {}

  // Returns true if polynomials of `degree` through degree + 1 pictures reproduce the pictures between them.
  bool is_polynomial(std::size_t degree) {
    Matrix identity(degree + 1, std::vector<double>(degree + 1));
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i <= degree; ++i) {
      identity[i][i] = 1.0;
      points.push_back(i * kFinest / degree);
    }
    return holds(points, family(points, identity), degree);
  }

  // Returns the smallest family whose combinations reproduce all pictures. Its pictures are at nodes of
  // `degree`.
  SpecularFamily smallest(std::size_t degree) {
    Matrix gram = gram_matrix(degree);
    std::vector<std::size_t> pivots;
    for (;;) {
      std::size_t next = 0;
      double most = -1.0;
      for (std::size_t i = 0; i < gram.size(); ++i) {
        if (std::ranges::find(pivots, i) != pivots.end() || gram[i][i] <= most) continue;
        next = i;
        most = gram[i][i];
      }
      eliminate(next, &gram);
      pivots.push_back(next);
      std::vector<std::size_t> points;
      Matrix shares;  // weight of each pivot in each node's picture
      for (const std::size_t pivot : pivots) {
        points.push_back(pivot * kFinest / degree);
        shares.push_back(gram[pivot]);
      }
      const SpecularFamily found = family(points, shares);
      if (pivots.size() == gram.size() || holds(points, found, degree)) return found;
    }
  }

 private:
  // Returns the picture at one of alphas_ and a Chebyshev point, both by index.
  const Radiances& picture(std::size_t width, std::size_t point) {
    const auto [known, is_new] = pictures_[width].try_emplace(point);
    if (is_new)
      known->second = picture_taker_.take(
          model_, RoleValues{alphas_[width], axis_.specular(chebyshev_point(point)), 0.0});
    return known->second;
  }

  // Returns the family of the pictures at `points`. The picture at node i of the polynomial is the sum over k
  // of shares[k][i] times the picture at points[k].
  SpecularFamily family(const std::vector<std::size_t>& points, const Matrix& shares) const {
    const std::size_t degree = shares.front().size() - 1;
    std::vector<double> nodes;
    for (std::size_t i = 0; i <= degree; ++i) nodes.push_back(chebyshev_point(i * kFinest / degree));
    SpecularFamily found = axis_;
    for (std::size_t k = 0; k < points.size(); ++k) {
      found.speculars.push_back(axis_.specular(chebyshev_point(points[k])));
      found.weights.emplace_back(degree + 1);
      for (std::size_t i = 0; i <= degree; ++i) {
        const std::vector<double> basis = lagrange_polynomial(nodes, i);
        for (std::size_t power = 0; power <= degree; ++power)
          found.weights.back()[power] += shares[k][i] * basis[power];
      }
    }
    return found;
  }

  // Returns true if combinations of the family give the pictures at every width, at twice as many nodes as
  // `degree` has.
  bool holds(const std::vector<std::size_t>& points, const SpecularFamily& family, std::size_t degree) {
    const std::size_t stride = kFinest / std::max(kLeastChecked, 2 * degree);
    for (std::size_t width = 0; width < alphas_.size(); ++width) {
      std::vector<Radiances> pictures;
      for (const std::size_t point : points) pictures.push_back(picture(width, point));
      const Radiances& full = picture(width, kFinest);
      const double allowed = picture_tolerance(model_) * *std::ranges::max_element(full);
      for (std::size_t point = 0; point <= kFinest; point += stride) {
        const Radiances expected =
            combined(pictures, family.weights_at(axis_.specular(chebyshev_point(point))));
        const Radiances& found = picture(width, point);
        for (std::size_t i = 0; i < found.size(); ++i)
          if (!(std::fabs(static_cast<double>(expected[i]) - found[i]) <= allowed)) return false;
      }
    }
    return true;
  }

  // Returns sums of inner products of the pictures at the nodes of `degree`, over all widths. Pictures are
  // divided by the brightest pixel of their width, so that all widths have the same weight.
  Matrix gram_matrix(std::size_t degree) {
    Matrix gram(degree + 1, std::vector<double>(degree + 1));
    for (std::size_t width = 0; width < alphas_.size(); ++width) {
      const Radiances& full = picture(width, kFinest);
      const double brightest = *std::ranges::max_element(full);
      for (std::size_t i = 0; i <= degree; ++i)
        for (std::size_t j = 0; j <= degree; ++j)
          gram[i][j] += inner_product(picture(width, i * kFinest / degree).data(),
                                      picture(width, j * kFinest / degree).data(), full.size()) /
                        (brightest * brightest);
    }
    return gram;
  }

  const PictureTaker& picture_taker_;
  const ModelDescription& model_;
  SpecularFamily axis_;  // only its range and coordinate_kind are used
  std::array<double, 3> alphas_;
  // The pictures of each width are keyed by the index of the point.
  std::array<std::map<std::size_t, Radiances>, 3> pictures_;
};

}  // namespace

std::optional<SpecularFamily> probe_family(const PictureTaker& picture_taker, const ModelDescription& model,
                                           const Range& alphas) {
  for (const SpecularCoordinate coordinate : {SpecularCoordinate::kEven, SpecularCoordinate::kRoot}) {
    FamilyProbe probe(picture_taker, model, alphas, coordinate);
    for (const std::size_t degree : {2u, 4u, 8u, 16u})
      if (probe.is_polynomial(degree)) return probe.smallest(degree);
  }
  return std::nullopt;
}

}  // namespace remap
