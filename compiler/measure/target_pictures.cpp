#include "measure/target_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "measure/objective.hpp"
#include "measure/probe.hpp"

namespace remap {
namespace {

// Steps at the upper end are narrower by this factor. All nodes of an interpolation there are on one side,
// which multiplies its error by about 40. A quarter of the step divides the error by 4^11.
constexpr double kEdgeRefinement = 4.0;

constexpr double kNarrowing = 4.0;

// This is the size of the grid for a target without a family.
constexpr std::size_t kWidths = 14;
constexpr std::size_t kSpeculars = 8;
constexpr std::size_t kMostMinima = 3;

// Returns widths in falling order, from the largest alpha. The first steps, as many as an interpolation
// needs, are narrow. Full steps follow, to the first width at or below the smallest alpha. If this width
// would be below `least`, the model's limit, the last width is the smallest alpha itself.
std::vector<double> bank_alphas(const Range& alphas, double ratio, double least) {
  const double bottom = std::log(alphas.min), top = std::log(alphas.max), step = std::log(ratio);
  double narrow_step = step / kEdgeRefinement;
  if (least < alphas.max)
    narrow_step =
        std::min(narrow_step, (top - std::log(least)) / static_cast<double>(kInterpolationNodes - 1));
  std::vector<double> logs = {top};
  while (logs.back() > bottom || logs.size() < kInterpolationNodes)
    logs.push_back(logs.back() - (logs.size() <= kInterpolationNodes ? narrow_step : step));
  const bool below = std::exp(logs.back()) < least;
  if (below) {
    // If two nodes were too close, the noise of pictures would grow.
    const double before_last = logs[logs.size() - 2];
    if (logs.size() > kInterpolationNodes && before_last - bottom < 0.5 * (before_last - logs.back()))
      logs.pop_back();
  }
  std::vector<double> widths;
  for (auto log = logs.rbegin(); log != logs.rend(); ++log) widths.push_back(std::exp(*log));
  if (below) widths.front() = alphas.min;
  widths.back() = alphas.max;
  return widths;
}

// This is the step of central differences, as a fraction of alpha or of the range. The truncation error is
// the square of the step. The rounding error is the error of a float, divided by the step.
constexpr double kDifferenceStep = 1e-3;
// This many pixels are interpolated together, because their sums fit into the first-level cache.
constexpr std::size_t kBlockPixels = 512;

// Returns the first of the nodes of the bank around `alpha`.
std::size_t first_node(const TargetBank& bank, double alpha) {
  std::size_t above = 0;
  while (above + 1 < bank.size() && bank.alpha(above) < alpha) ++above;
  return std::min(above - std::min(above, kInterpolationNodes / 2), bank.size() - kInterpolationNodes);
}

// Returns the Lagrange basis of the nodes from `first`, in log(alpha).
LagrangeBasis basis_at(const TargetBank& bank, std::size_t first, double alpha) {
  LagrangeBasis::Values logs{};
  for (std::size_t i = 0; i < kInterpolationNodes; ++i) logs[i] = std::log(bank.alpha(first + i));
  return LagrangeBasis(logs, std::log(alpha));
}

using PixelBlock = std::array<double, kBlockPixels>;

void add_scaled(double factor, const float* values, std::size_t count, PixelBlock* sums) {
  for (std::size_t i = 0; i < count; ++i) (*sums)[i] += factor * static_cast<double>(values[i]);
}

}  // namespace

Range searched_widths(const ModelDescription& target, double narrowest) {
  return {std::max(target.alpha.min, narrowest / kNarrowing), target.alpha.max};
}

TargetBank::TargetBank(const PictureTaker& picture_taker, const ProbedModel& target, const Range& alphas,
                       double ratio)
    : picture_taker_(picture_taker),
      target_(target),
      family_(target.family().value()),
      log_step_(std::log(ratio)),
      alphas_(bank_alphas(alphas, ratio, target.model.alpha.min)),
      are_rendered_(alphas_.size()),
      are_begun_(alphas_.size()),
      pictures_(alphas_.size()) {}

const std::vector<std::vector<float>>& TargetBank::pictures(std::size_t node) const {
  are_begun_[node] = true;
  std::call_once(are_rendered_[node],
                 [&] { pictures_[node] = take_family(picture_taker_, target_, alphas_[node]); });
  return pictures_[node];
}

void TargetBank::prepare(std::span<const std::size_t> nodes) const {
  for (const std::size_t node : nodes)
    if (!are_begun_[node].exchange(true)) pictures(node);
}

TargetGrid::TargetGrid(const PictureTaker& picture_taker, const ProbedModel& target, const Range& alphas)
    : picture_taker_(picture_taker),
      target_(target),
      are_rendered_(kWidths * kSpeculars),
      pictures_(are_rendered_.size()) {
  const Range speculars = target.linear_range();
  for (std::size_t i = 0; i < kWidths; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kWidths - 1);
    const double alpha = alphas.min * std::pow(alphas.max / alphas.min, share);
    for (std::size_t j = 1; j <= kSpeculars; ++j)
      points_.push_back({std::min(alpha, alphas.max),
                         speculars.min + (speculars.max - speculars.min) * static_cast<double>(j) /
                                             static_cast<double>(kSpeculars),
                         0.0});
  }
}

const std::vector<float>& TargetGrid::picture(std::size_t point) const {
  std::call_once(are_rendered_[point],
                 [&] { pictures_[point] = picture_taker_.take(target_, points_[point]); });
  return pictures_[point];
}

std::vector<RoleValues> TargetGrid::minima(const std::vector<float>& source,
                                           const std::vector<float>& weights) const {
  std::vector<double> losses(points_.size());
  std::vector<float> difference(source.size());
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::vector<float>& target = picture(p);
    for (std::size_t i = 0; i < source.size(); ++i) difference[i] = target[i] - source[i];
    losses[p] = weighted_product(weights.data(), difference.data(), difference.data(), source.size());
  }
  const auto is_minimum = [&](std::size_t p) {
    const std::size_t i = p / kSpeculars, j = p % kSpeculars;
    for (std::size_t k = i - std::min<std::size_t>(i, 1); k <= std::min(i + 1, kWidths - 1); ++k)
      for (std::size_t l = j - std::min<std::size_t>(j, 1); l <= std::min(j + 1, kSpeculars - 1); ++l)
        if (losses[k * kSpeculars + l] < losses[p]) return false;
    return true;
  };
  std::vector<std::size_t> found;
  for (std::size_t p = 0; p < points_.size(); ++p)
    if (is_minimum(p)) found.push_back(p);
  std::ranges::sort(found, [&](std::size_t a, std::size_t b) { return losses[a] < losses[b]; });
  std::vector<RoleValues> starts;
  for (std::size_t i = 0; i < std::min(found.size(), kMostMinima); ++i) starts.push_back(points_[found[i]]);
  return starts;
}

TargetPictures::TargetPictures(const ProbedModel& target, const Range& alphas,
                               const std::vector<std::string>& others) {
  const ModelDescription& model = target.model;
  const bool grey_diffuse =
      model.has(ParameterRole::kDiffuse) && model.parameter(ParameterRole::kDiffuse).grey;
  coordinates_ = {{"", alphas, true},
                  {"", target.linear_range(), model.parameter(ParameterRole::kSpecular).grey},
                  {"", target.diffuse_range(), grey_diffuse}};
  for (const std::string& name : others)
    coordinates_.push_back({name, model.parameter(name).range, model.parameter(name).grey});
}

double TargetPictures::value(const RoleValues& point, std::size_t coordinate) const {
  if (coordinate == kAlphaCoordinate) return point.alpha;
  if (coordinate == kSpecularCoordinate) return point.specular;
  if (coordinate == kDiffuseCoordinate) return point.diffuse;
  return point.others.at(coordinates_[coordinate].name);
}

void TargetPictures::set_value(RoleValues* point, std::size_t coordinate, double value) const {
  if (coordinate == kAlphaCoordinate) point->alpha = value;
  if (coordinate == kSpecularCoordinate) point->specular = value;
  if (coordinate == kDiffuseCoordinate) point->diffuse = value;
  if (coordinate > kDiffuseCoordinate) point->others[coordinates_[coordinate].name] = value;
}

BankPictures::BankPictures(const PictureTaker& picture_taker, const ProbedModel& target,
                           const TargetBank& bank)
    : TargetPictures(target, {bank.alpha(0), bank.alpha(bank.size() - 1)}, {}), bank_(bank) {
  const Range diffuses = target.diffuse_range();
  if (!(diffuses.max > diffuses.min)) {
    diffuse_.resize(bank.pictures(bank.size() - 1).front().size());
    return;
  }
  const RoleValues lit{bank.alpha(bank.size() - 1), target.linear_range().min, diffuses.max};
  RoleValues unlit = lit;
  unlit.diffuse = diffuses.min;
  diffuse_ = picture_taker.take(target, lit);
  const std::vector<float> dark = picture_taker.take(target, unlit);
  const double scale = 1.0 / (diffuses.max - diffuses.min);
  for (std::size_t i = 0; i < dark.size(); ++i)
    diffuse_[i] = static_cast<float>((static_cast<double>(diffuse_[i]) - dark[i]) * scale);
}

std::vector<PictureTangents> BankPictures::at(const std::vector<RoleValues>& points,
                                              const std::vector<bool>& wanted) const {
  std::vector<PictureTangents> results;
  results.reserve(points.size());
  for (auto begin = points.begin(); begin != points.end();) {
    const auto end = std::find_if(begin, points.end(),
                                  [&](const RoleValues& point) { return point.alpha != begin->alpha; });
    add_at_width({begin, end}, wanted, &results);
    begin = end;
  }
  return results;
}

void BankPictures::add_at_width(std::span<const RoleValues> points, const std::vector<bool>& wanted,
                                std::vector<PictureTangents>* results) const {
  const double alpha = points.front().alpha;
  const std::size_t begin = first_node(bank_, alpha);
  const LagrangeBasis basis = basis_at(bank_, begin, alpha);
  std::array<const std::vector<std::vector<float>>*, kInterpolationNodes> nodes{};
  for (std::size_t i = 0; i < kInterpolationNodes; ++i) nodes[i] = &bank_.pictures(begin + i);
  const std::size_t pixels = diffuse_.size(), members = nodes.front()->size(), first = results->size();
  std::vector<std::vector<double>> weights, slopes;
  for (const RoleValues& point : points) {
    weights.push_back(bank_.family().weights_at(point.specular));
    slopes.push_back(bank_.family().slopes_at(point.specular));
    results->push_back({std::vector<float>(pixels),
                        {std::vector<float>(pixels), std::vector<float>(pixels),
                         wanted[kDiffuseCoordinate] ? diffuse_ : std::vector<float>()}});
  }
  // the same blocks are used for all points
  std::vector<PixelBlock> interpolated(members), interpolated_rise(members);
  for (std::size_t start = 0; start < pixels; start += kBlockPixels) {
    const std::size_t count = std::min(kBlockPixels, pixels - start);
    for (std::size_t k = 0; k < members; ++k) {
      interpolated[k] = interpolated_rise[k] = {};
      for (std::size_t i = 0; i < kInterpolationNodes; ++i) {
        const float* values = &(*nodes[i])[k][start];
        add_scaled(basis.value[i], values, count, &interpolated[k]);
        add_scaled(basis.derivative[i], values, count, &interpolated_rise[k]);
      }
    }
    for (std::size_t p = 0; p < points.size(); ++p) {
      PixelBlock picture{}, slope{}, rise{};
      for (std::size_t k = 0; k < members; ++k)
        for (std::size_t i = 0; i < count; ++i) {
          picture[i] += weights[p][k] * interpolated[k][i];
          slope[i] += slopes[p][k] * interpolated[k][i];
          rise[i] += weights[p][k] * interpolated_rise[k][i];
        }
      PictureTangents& result = (*results)[first + p];
      for (std::size_t i = 0; i < count; ++i) {
        result.picture[start + i] = static_cast<float>(picture[i] + points[p].diffuse * diffuse_[start + i]);
        result.by[kSpecularCoordinate][start + i] = static_cast<float>(slope[i]);
        result.by[kAlphaCoordinate][start + i] = static_cast<float>(rise[i] / alpha);
      }
    }
  }
}

RenderedPictures::RenderedPictures(const PictureTaker& picture_taker, const ProbedModel& target,
                                   const Range& alphas, const std::vector<std::string>& others)
    : TargetPictures(target, alphas, others), picture_taker_(picture_taker), target_(target) {}

std::vector<PictureTangents> RenderedPictures::at(const std::vector<RoleValues>& points,
                                                  const std::vector<bool>& wanted) const {
  std::vector<PictureTangents> results;
  for (const RoleValues& point : points) results.push_back(at_point(point, wanted));
  return results;
}

PictureTangents RenderedPictures::at_point(const RoleValues& point, const std::vector<bool>& wanted) const {
  PictureTangents result{picture_taker_.take(target_, point), {}};
  for (std::size_t c = 0; c < coordinates().size(); ++c) {
    result.by.emplace_back();
    if (!wanted[c]) continue;
    const Range& range = coordinates()[c].range;
    const double at = value(point, c);
    const double step = kDifferenceStep * (c == kAlphaCoordinate ? at : range.max - range.min);
    const double low = std::max(range.min, at - step), high = std::min(range.max, at + step);
    RoleValues moved = point;
    set_value(&moved, c, low);
    const std::vector<float> from = picture_taker_.take(target_, moved);
    set_value(&moved, c, high);
    std::vector<float>& rise = result.by.back();
    rise = picture_taker_.take(target_, moved);
    for (std::size_t i = 0; i < rise.size(); ++i)
      rise[i] = static_cast<float>((static_cast<double>(rise[i]) - from[i]) / (high - low));
  }
  return result;
}

MatchTarget match_target(const PictureTaker& picture_taker, const ProbedModel& target, const Range& searched,
                         const Range& probed, bool with_diffuse, const std::vector<std::string>& others) {
  MatchTarget result{target, nullptr, nullptr};
  const ModelDescription& model = target.model;
  if (!target.response.affine() && others.empty()) result.curve = probe_family(picture_taker, model, probed);
  if (result.family() && others.empty())
    result.bank = std::make_unique<TargetBank>(picture_taker, result, searched, kBankRatio);
  const bool adds = result.bank && with_diffuse &&
                    (!model.has(ParameterRole::kDiffuse) || probe_diffuse(picture_taker, model, probed));
  if (adds)
    result.pictures = std::make_unique<BankPictures>(picture_taker, result, *result.bank);
  else if (!result.bank || with_diffuse)
    result.pictures = std::make_unique<RenderedPictures>(picture_taker, result, searched, others);
  return result;
}

}  // namespace remap
