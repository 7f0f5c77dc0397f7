#include "sweep/target_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sweep/interpolation.hpp"

namespace remapc {
namespace {

using remap::Range;

// Step of central differences, as a share of alpha or of the range: its square is what differences leave, and
// floats divided by it what rounding leaves.
constexpr double kDifferenceStep = 1e-3;
// Pixels that are interpolated together: sums of that many lie in the first-level cache.
constexpr std::size_t kBlockPixels = 512;

// Nodes of the bank around `alpha` and their Lagrange basis in log(alpha).
struct Window {
  std::size_t first;
  LagrangeBasis basis;

  static Window around(const TargetBank& bank, double alpha) {
    std::size_t above = 0;
    while (above + 1 < bank.size() && bank.alpha(above) < alpha) ++above;
    const std::size_t first =
        std::min(above - std::min(above, kInterpolationNodes / 2), bank.size() - kInterpolationNodes);
    LagrangeBasis::Values logs{};
    for (std::size_t i = 0; i < kInterpolationNodes; ++i) logs[i] = std::log(bank.alpha(first + i));
    return {first, LagrangeBasis(logs, std::log(alpha))};
  }
};

using Block = std::array<double, kBlockPixels>;

void add_scaled(double factor, const float* values, std::size_t count, Block* sums) {
  for (std::size_t i = 0; i < count; ++i) (*sums)[i] += factor * static_cast<double>(values[i]);
}

}  // namespace

BankPictures::BankPictures(const Photographer& photographer, const Subject& target, const TargetBank& bank)
    : bank_(bank),
      black_base_(target.response.proportional()),
      alphas_{bank.alpha(0), bank.alpha(bank.size() - 1)},
      speculars_(target.linear_range()),
      diffuses_(target.diffuse_range()) {
  const std::vector<float> dark = photographer.take(target, {alphas_.max, speculars_.min, diffuses_.min});
  diffuse_ = photographer.take(target, {alphas_.max, speculars_.min, diffuses_.max});
  const double scale = 1.0 / (diffuses_.max - diffuses_.min);
  for (std::size_t i = 0; i < dark.size(); ++i)
    diffuse_[i] = static_cast<float>((static_cast<double>(diffuse_[i]) - dark[i]) * scale);
}

PictureTangents BankPictures::at(const Sitting& point, bool with_diffuse) const {
  const Window window = Window::around(bank_, point.alpha);
  const std::size_t pixels = diffuse_.size();
  PictureTangents result{std::vector<float>(pixels), std::vector<float>(pixels), std::vector<float>(pixels),
                         with_diffuse ? diffuse_ : std::vector<float>()};
  std::array<const BankEntry*, kInterpolationNodes> entries{};
  for (std::size_t i = 0; i < kInterpolationNodes; ++i) entries[i] = &bank_.entry(window.first + i);
  for (std::size_t start = 0; start < pixels; start += kBlockPixels) {
    const std::size_t count = std::min(kBlockPixels, pixels - start);
    Block base{}, slope{}, base_rise{}, slope_rise{};
    for (std::size_t i = 0; i < kInterpolationNodes; ++i) {
      add_scaled(window.basis.value[i], &entries[i]->slope[start], count, &slope);
      add_scaled(window.basis.derivative[i], &entries[i]->slope[start], count, &slope_rise);
      if (black_base_) continue;
      add_scaled(window.basis.value[i], &entries[i]->base[start], count, &base);
      add_scaled(window.basis.derivative[i], &entries[i]->base[start], count, &base_rise);
    }
    for (std::size_t i = 0; i < count; ++i) {
      result.picture[start + i] =
          static_cast<float>(base[i] + point.specular * slope[i] + point.diffuse * diffuse_[start + i]);
      result.by_specular[start + i] = static_cast<float>(slope[i]);
      result.by_alpha[start + i] =
          static_cast<float>((base_rise[i] + point.specular * slope_rise[i]) / point.alpha);
    }
  }
  return result;
}

RenderedPictures::RenderedPictures(const Photographer& photographer, const Subject& target,
                                   const Range& alphas)
    : photographer_(photographer),
      target_(target),
      alphas_(alphas),
      speculars_(target.linear_range()),
      diffuses_(target.diffuse_range()) {}

PictureTangents RenderedPictures::at(const Sitting& point, bool with_diffuse) const {
  const auto derivative = [&](double Sitting::*parameter, const Range& range, double step) {
    Sitting low = point, high = point;
    low.*parameter = std::max(range.min, point.*parameter - step);
    high.*parameter = std::min(range.max, point.*parameter + step);
    std::vector<float> rise = photographer_.take(target_, high);
    const std::vector<float> from = photographer_.take(target_, low);
    const double scale = 1.0 / (high.*parameter - low.*parameter);
    for (std::size_t i = 0; i < rise.size(); ++i)
      rise[i] = static_cast<float>((static_cast<double>(rise[i]) - from[i]) * scale);
    return rise;
  };
  const auto share = [](const Range& range) { return kDifferenceStep * (range.max - range.min); };
  return {photographer_.take(target_, point),
          derivative(&Sitting::alpha, alphas_, kDifferenceStep * point.alpha),
          derivative(&Sitting::specular, speculars_, share(speculars_)),
          with_diffuse ? derivative(&Sitting::diffuse, diffuses_, share(diffuses_)) : std::vector<float>()};
}

}  // namespace remapc
