#include "measure/match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "measure/objective.hpp"
#include "measure/target_pictures.hpp"

namespace remap {
namespace {

// The search starts at every sixth node of the bank, because minima of the loss are much wider than six
// nodes.
constexpr std::size_t kCoarseStride = 6;
// A second minimum makes a match unstable if its error is within 1 % of the best error and its width is more
// than two bank steps away.
constexpr double kRivalError = 1.01;
// A match is also unstable if a second specular at the same width differs by this fraction of the range.
// Errors up to kSameError are treated as equal, because they come from rounding in pictures.
constexpr double kRivalDistance = 0.02;
constexpr double kSameError = 1e-4;

// Return the sum of a * b, and of weights * a * b, over the numbers `at` of pictures.
double part_product(const std::vector<std::size_t>& at, const std::vector<float>& a,
                    const std::vector<float>& b) {
  double sum = 0.0;
  for (const std::size_t i : at) sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return sum;
}

double part_product(const PictureWeights& weights, const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (const std::size_t i : weights.means)
    sum += static_cast<double>(weights.squared[i]) * static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return sum;
}

void add(double factor, const std::vector<double>& polynomial, std::vector<double>* sum) {
  sum->resize(std::max(sum->size(), polynomial.size()));
  for (std::size_t i = 0; i < polynomial.size(); ++i) (*sum)[i] += factor * polynomial[i];
}

double quadratic_form(const std::vector<std::vector<double>>& matrix,
                      const std::vector<double>& coefficients) {
  double sum = 0.0;
  for (std::size_t i = 0; i < matrix.size(); ++i)
    for (std::size_t j = 0; j < matrix.size(); ++j) sum += coefficients[i] * coefficients[j] * matrix[i][j];
  return sum;
}

// Interpolates the losses at neighbouring nodes, coefficient by coefficient.
std::vector<double> interpolated(const std::array<std::vector<double>, kInterpolationNodes>& losses,
                                 const LagrangeBasis::Values& weights) {
  std::vector<double> total(losses.front().size());
  for (std::size_t i = 0; i < kInterpolationNodes; ++i)
    for (std::size_t k = 0; k < total.size(); ++k) total[k] += weights[i] * losses[i][k];
  return total;
}

}  // namespace

Matcher::Matcher(const TargetBank& bank, std::vector<std::vector<float>> basis, PictureWeights weights)
    : bank_(bank), basis_(std::move(basis)), weights_(std::move(weights)) {
  for (const auto& picture : basis_) {
    std::vector<float> weighted(picture.size());
    for (std::size_t i = 0; i < picture.size(); ++i) weighted[i] = picture[i] * weights_.squared[i];
    weighted_basis_.push_back(std::move(weighted));
  }
  for (const auto& weighted : weighted_basis_) {
    power_.emplace_back();
    power_of_means_.emplace_back();
    for (const auto& picture : basis_) {
      power_.back().push_back(inner_product(weighted.data(), picture.data(), picture.size()));
      power_of_means_.back().push_back(part_product(weights_.means, weighted, picture));
    }
  }
}

const Matcher::Products& Matcher::products(std::size_t node) {
  const auto known = products_.find(node);
  if (known != products_.end()) return known->second;
  const std::vector<std::vector<float>>& pictures = bank_.pictures(node);
  const std::vector<Polynomial>& weights = bank_.family().weights;
  Products p;
  for (std::size_t j = 0; j < pictures.size(); ++j)
    for (std::size_t k = j; k < pictures.size(); ++k) {
      const double count = j == k ? 1.0 : 2.0;
      const Polynomial polynomial = polynomial_product(weights[j], weights[k]);
      add(count * weighted_product(weights_.squared.data(), pictures[j].data(), pictures[k].data(),
                                   weights_.squared.size()),
          polynomial, &p.power);
      add(count * part_product(weights_, pictures[j], pictures[k]), polynomial, &p.power_of_means);
    }
  for (const auto& source : weighted_basis_) {
    p.cross.emplace_back();
    p.cross_of_means.emplace_back();
    for (std::size_t k = 0; k < pictures.size(); ++k) {
      add(inner_product(source.data(), pictures[k].data(), source.size()), weights[k], &p.cross.back());
      add(part_product(weights_.means, source, pictures[k]), weights[k], &p.cross_of_means.back());
    }
  }
  return products_.emplace(node, std::move(p)).first->second;
}

// Returns |I - T|^2 = II - 2 IT + TT, all weighted. It omits II, which does not depend on the target, so that
// refine() can differentiate the rest without cancellation.
Matcher::Polynomial Matcher::loss(const Polynomial& power, const std::vector<Polynomial>& cross,
                                  const std::vector<double>& coefficients) {
  Polynomial result = power;
  Polynomial sum(cross.front().size());
  for (std::size_t b = 0; b < coefficients.size(); ++b)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += coefficients[b] * cross[b][i];
  for (std::size_t i = 0; i < sum.size(); ++i) result[i] -= 2.0 * sum[i];
  return result;
}

double Matcher::best_coordinate(const Polynomial& loss) const {
  return polynomial_minima(loss, bank_.family().coordinate_range()).front();
}

double Matcher::loss_at_node(std::size_t node, const std::vector<double>& coefficients) {
  const Products& p = products(node);
  const Polynomial total = loss(p.power, p.cross, coefficients);
  return polynomial_value(total, best_coordinate(total));
}

std::size_t Matcher::descend(std::size_t node, const std::vector<double>& coefficients) {
  double lowest = loss_at_node(node, coefficients);
  for (;;) {
    std::size_t next = node;
    for (const std::size_t neighbour : {node - 1, node + 1}) {  // node - 1 may wrap around, out of range
      if (neighbour >= bank_.size()) continue;
      const double candidate = loss_at_node(neighbour, coefficients);
      if (candidate < lowest) {
        lowest = candidate;
        next = neighbour;
      }
    }
    if (next == node) return node;
    node = next;
  }
}

Match Matcher::refine(std::size_t node, const std::vector<double>& coefficients) {
  const std::size_t first =
      std::min(node - std::min(node, kInterpolationNodes / 2 - 1), bank_.size() - kInterpolationNodes);
  std::array<std::size_t, kInterpolationNodes> nodes{};
  std::iota(nodes.begin(), nodes.end(), first);
  bank_.prepare(nodes);
  std::array<Polynomial, kInterpolationNodes> losses, losses_of_means;
  LagrangeBasis::Values logs{};  // values of log(alpha)
  for (std::size_t i = 0; i < kInterpolationNodes; ++i) {
    const Products& p = products(first + i);
    losses[i] = loss(p.power, p.cross, coefficients);
    losses_of_means[i] = loss(p.power_of_means, p.cross_of_means, coefficients);
    logs[i] = std::log(bank_.alpha(first + i));
  }
  // Returns the derivative of the loss by log(alpha) at the best specular. The derivative by specular is 0
  // there, so the change of the specular does not contribute.
  const auto derivative = [&](double x) {
    const LagrangeBasis basis(logs, x);
    return polynomial_value(interpolated(losses, basis.derivative),
                            best_coordinate(interpolated(losses, basis.value)));
  };

  const bool at_edge = node == 0 || node + 1 == bank_.size();
  double low = std::log(bank_.alpha(node == 0 ? node : node - 1));
  double high = std::log(bank_.alpha(node + 1 == bank_.size() ? node : node + 1));
  double x = std::log(bank_.alpha(node));
  const bool bracketed = derivative(low) <= 0.0 && derivative(high) >= 0.0;
  // Bisects to the resolution of doubles; one step costs a few hundred operations.
  for (int step = 0; bracketed && step < 52; ++step) {
    x = 0.5 * (low + high);
    (derivative(x) < 0.0 ? low : high) = x;
  }
  const LagrangeBasis::Values at = LagrangeBasis(logs, x).value;
  Match match = match_at(x, interpolated(losses, at), interpolated(losses_of_means, at), coefficients);
  if (at_edge && !bracketed && match.status == RowStatus::kOk) match.status = RowStatus::kClamped;
  return match;
}

// Returns the match at log(alpha) = `x`, from the loss at this width and the part of the loss that means
// contribute.
Match Matcher::match_at(double x, const Polynomial& loss, const Polynomial& loss_of_means,
                        const std::vector<double>& coefficients) const {
  const SpecularFamily& family = bank_.family();
  const Range range = family.coordinate_range();
  const double power = quadratic_form(power_, coefficients);
  const double power_of_means = quadratic_form(power_of_means_, coefficients);
  const auto error = [&](double coordinate) {
    return std::sqrt(std::max(0.0, power + polynomial_value(loss, coordinate)) / power);
  };
  const std::vector<double> minima = polynomial_minima(loss, range);
  const double best = minima.front();
  const double of_means = power_of_means + polynomial_value(loss_of_means, best);
  const double of_pixels = std::max(0.0, power + polynomial_value(loss, best) - of_means);
  Match match{{{std::exp(x), family.specular(best), 0.0}},
              error(best),
              std::sqrt(of_pixels / (power - power_of_means))};
  if (best <= range.min || best >= range.max) match.status = RowStatus::kClamped;
  for (std::size_t i = 1; i < minima.size(); ++i) {
    const bool apart = std::fabs(minima[i] - best) > kRivalDistance * (range.max - range.min);
    if (apart && error(minima[i]) < kRivalError * match.error + kSameError)
      match.status = RowStatus::kUnstable;
  }
  return match;
}

// Returns the minima of the loss on every sixth node.
std::vector<std::size_t> Matcher::coarse_minima(const std::vector<double>& coefficients) {
  std::vector<std::size_t> coarse;
  for (std::size_t node = 0; node < bank_.size(); node += kCoarseStride) coarse.push_back(node);
  if (coarse.back() + 1 != bank_.size()) coarse.push_back(bank_.size() - 1);
  bank_.prepare(coarse);
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const double loss = loss_at_node(coarse[i], coefficients);
    const bool left = i == 0 || loss <= loss_at_node(coarse[i - 1], coefficients);
    const bool right = i + 1 == coarse.size() || loss <= loss_at_node(coarse[i + 1], coefficients);
    if (left && right) minima.push_back(coarse[i]);
  }
  return minima;
}

Match Matcher::match(const std::vector<double>& coefficients, std::vector<std::size_t>* minima) {
  if (minima->empty()) *minima = coarse_minima(coefficients);
  for (std::size_t& node : *minima) node = descend(node, coefficients);
  std::ranges::sort(*minima);
  minima->erase(std::unique(minima->begin(), minima->end()), minima->end());

  std::vector<Match> candidates;
  for (const std::size_t node : *minima) candidates.push_back(refine(node, coefficients));
  Match match = *std::ranges::min_element(candidates, {}, &Match::error);
  for (const Match& rival : candidates) {
    const bool apart =
        std::fabs(std::log(rival.point().alpha / match.point().alpha)) > 2.0 * bank_.log_step();
    if (apart && rival.error < kRivalError * match.error) match.status = RowStatus::kUnstable;
  }
  return match;
}

}  // namespace remap
