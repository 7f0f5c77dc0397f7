#include "sweep/match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "sweep/interpolation.hpp"
#include "sweep/picture_sums.hpp"

namespace remapc {
namespace {

// Every sixth node of the bank is looked at first; lobes are far wider than that.
constexpr std::size_t kCoarseStride = 6;
// A second minimum counts as a rival where its error is within 1 % of the best and its width is not a
// neighbour.
constexpr double kRivalError = 1.01;

}  // namespace

Matcher::Matcher(const TargetBank& bank, std::vector<std::vector<float>> basis,
                 std::vector<float> squared_weights)
    : bank_(bank), basis_(std::move(basis)), weights_(std::move(squared_weights)) {
  for (const auto& picture : basis_) {
    std::vector<float> weighted(picture.size());
    for (std::size_t i = 0; i < picture.size(); ++i) weighted[i] = picture[i] * weights_[i];
    weighted_basis_.push_back(std::move(weighted));
  }
  for (std::size_t i = 0; i < basis_.size(); ++i)
    for (std::size_t j = 0; j < basis_.size(); ++j)
      power_[i][j] = inner_product(weighted_basis_[i].data(), basis_[j].data(), basis_[j].size());
}

const Matcher::Products& Matcher::products(std::size_t node) {
  const auto known = products_.find(node);
  if (known != products_.end()) return known->second;
  const BankEntry& entry = bank_.entry(node);
  const float *base = entry.base.data(), *slope = entry.slope.data();
  const float *weights = weights_.data(), *source = weighted_basis_[0].data();
  LaneSums aa{}, ab{}, bb{}, xa{}, xb{};
  for_each_pixel(weights_.size(), [&](std::size_t i, std::size_t lane) {
    const double a = base[i], b = slope[i], w = weights[i], x = source[i];
    aa[lane] += w * a * a;
    ab[lane] += w * a * b;
    bb[lane] += w * b * b;
    xa[lane] += x * a;
    xb[lane] += x * b;
  });
  Products p;
  p.aa = total(aa), p.ab = total(ab), p.bb = total(bb), p.xa[0] = total(xa), p.xb[0] = total(xb);
  if (basis_.size() == 2) {
    p.xa[1] = inner_product(weighted_basis_[1].data(), base, weights_.size());
    p.xb[1] = inner_product(weighted_basis_[1].data(), slope, weights_.size());
  }
  return products_.emplace(node, p).first->second;
}

double Matcher::source_power(const std::vector<double>& coefficients) const {
  double power = 0.0;
  for (std::size_t i = 0; i < basis_.size(); ++i)
    for (std::size_t j = 0; j < basis_.size(); ++j) power += coefficients[i] * coefficients[j] * power_[i][j];
  return power;
}

// |I - A - s B|^2 = (II - 2 IA + AA) - 2 s (IB - AB) + s^2 BB, all weighted. II is left out here: it does not
// depend on the width, and refine() differentiates.
Matcher::Quadratic Matcher::quadratic(const Products& p, const std::vector<double>& coefficients) const {
  double ia = 0.0, ib = 0.0;
  for (std::size_t k = 0; k < basis_.size(); ++k) {
    ia += coefficients[k] * p.xa[k];
    ib += coefficients[k] * p.xb[k];
  }
  return {p.aa - 2.0 * ia, ib - p.ab, p.bb};
}

Matcher::Optimum Matcher::optimum(const Quadratic& q) const {
  const double best = q.c2 > 0.0 ? q.c1 / q.c2 : 0.0;
  const double specular = std::clamp(best, bank_.min_specular(), bank_.max_specular());
  return {specular, q.c0 + specular * (specular * q.c2 - 2.0 * q.c1)};
}

double Matcher::loss_at_node(std::size_t node, const std::vector<double>& coefficients) {
  return optimum(quadratic(products(node), coefficients)).loss;
}

std::size_t Matcher::descend(std::size_t node, const std::vector<double>& coefficients) {
  double loss = loss_at_node(node, coefficients);
  for (;;) {
    std::size_t next = node;
    for (const std::size_t neighbour : {node - 1, node + 1}) {  // node - 1 wraps at 0 and fails the check
      if (neighbour >= bank_.size()) continue;
      const double candidate = loss_at_node(neighbour, coefficients);
      if (candidate < loss) {
        loss = candidate;
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
  std::array<Quadratic, kInterpolationNodes> window;
  LagrangeBasis::Values logs{};
  for (std::size_t i = 0; i < kInterpolationNodes; ++i) {
    window[i] = quadratic(products(first + i), coefficients);
    logs[i] = std::log(bank_.alpha(first + i));
  }
  const auto interpolate = [&](const LagrangeBasis::Values& basis) {
    Quadratic sum;
    for (std::size_t i = 0; i < kInterpolationNodes; ++i) {
      sum.c0 += basis[i] * window[i].c0;
      sum.c1 += basis[i] * window[i].c1;
      sum.c2 += basis[i] * window[i].c2;
    }
    return sum;
  };
  // Derivative of the loss by log(alpha) at the best specular: what the specular would do does not matter
  // there.
  const auto derivative = [&](double x) {
    const LagrangeBasis basis(logs, x);
    const double s = optimum(interpolate(basis.value)).specular;
    const Quadratic d = interpolate(basis.derivative);
    return d.c0 + s * (s * d.c2 - 2.0 * d.c1);
  };

  const bool at_edge = node == 0 || node + 1 == bank_.size();
  double low = std::log(bank_.alpha(node == 0 ? node : node - 1));
  double high = std::log(bank_.alpha(node + 1 == bank_.size() ? node : node + 1));
  double x = std::log(bank_.alpha(node));
  const bool bracketed = derivative(low) <= 0.0 && derivative(high) >= 0.0;
  // Bisection to the resolution of doubles; each step is a few hundred operations.
  for (int step = 0; bracketed && step < 52; ++step) {
    x = 0.5 * (low + high);
    (derivative(x) < 0.0 ? low : high) = x;
  }
  const Optimum best = optimum(interpolate(LagrangeBasis(logs, x).value));
  const double power = source_power(coefficients);
  Match match;
  match.alpha = std::exp(x);
  match.specular = best.specular;
  match.error = std::sqrt(std::max(0.0, power + best.loss) / power);
  const bool clamped = (at_edge && !bracketed) || best.specular <= bank_.min_specular() ||
                       best.specular >= bank_.max_specular();
  match.status = clamped ? RowStatus::kClamped : RowStatus::kOk;
  return match;
}

// Minima of the loss on every sixth node.
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
  std::sort(minima->begin(), minima->end());
  minima->erase(std::unique(minima->begin(), minima->end()), minima->end());

  std::vector<Match> candidates;
  for (const std::size_t node : *minima) candidates.push_back(refine(node, coefficients));
  const auto better = [](const Match& a, const Match& b) { return a.error < b.error; };
  Match match = *std::min_element(candidates.begin(), candidates.end(), better);
  for (const Match& rival : candidates) {
    const bool apart = std::fabs(std::log(rival.alpha / match.alpha)) > 2.0 * bank_.log_step();
    if (apart && rival.error < kRivalError * match.error) match.status = RowStatus::kUnstable;
  }
  return match;
}

}  // namespace remapc
