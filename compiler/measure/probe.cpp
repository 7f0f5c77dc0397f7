#include "measure/probe.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "measure/objective.hpp"
#include "renderer/fresnel.hpp"

namespace remap {
namespace {

using Radiances = std::vector<float>;

// This tolerance follows from floats: a combination of three pictures is exact to a few 2^-24 of the
// brightest pixel.
constexpr double kPictureTolerance = 2e-6;
// A quotient of sums over many pixels is more accurate than one pixel.
constexpr double kRatioTolerance = 1e-6;
// This is the relative precision for the width at which a renderer begins to clamp.
constexpr double kWidthPrecision = 2e-3;
// Bisection ends after this many halvings, because a knee below 2^-20 of the range has no practical effect.
constexpr int kMostHalvings = 20;

// Returns the tolerance for a quotient of sums. It is at least kRatioTolerance, and larger for imprecise
// renderers.
double ratio_tolerance(const ModelDescription& model) { return std::max(kRatioTolerance, model.precision); }

double brightest(const Radiances& picture) { return *std::ranges::max_element(picture); }

// Returns the largest |(1 - t) low + t high - found|, relative to the brightest pixel of `high`.
double line_deviation(const Radiances& low, const Radiances& high, double t, const Radiances& found) {
  double worst = 0.0;
  for (std::size_t i = 0; i < low.size(); ++i) {
    const double expected = low[i] + t * (static_cast<double>(high[i]) - low[i]);
    worst = std::max(worst, std::fabs(expected - found[i]));
  }
  return worst / brightest(high);
}

bool is_black(const Radiances& picture) {
  return std::ranges::all_of(picture, [](float value) { return value == 0.0f; });
}

// A WidthProbe renders a model at one width, at the ends and in the middle of its specular range.
struct WidthProbe {
  double alpha;
  Radiances low, middle, high;
};

class SpecularProbe {
 public:
  SpecularProbe(const PictureTaker& picture_taker, const ModelDescription& model, const Range& alphas)
      : picture_taker_(picture_taker),
        model_(model),
        range_(model.parameter(ParameterRole::kSpecular).range) {
    for (const double alpha : {alphas.min, std::sqrt(alphas.min * alphas.max), alphas.max}) {
      WidthProbe probe{alpha, take(alpha, range_.min), take(alpha, 0.5 * (range_.min + range_.max)),
                       take(alpha, range_.max)};
      if (!(brightest(probe.high) > 0.0))
        throw input_error(model.name + ": the picture at full specular is black; a highlight is needed");
      widths_.push_back(std::move(probe));
    }
  }

  SpecularResponse law() const {
    const double from_affine = affine_deviation();
    SpecularResponse response{SpecularLaw::kOther, black_at_zero(), 0.0, from_affine};
    if (from_affine <= picture_tolerance(model_)) {
      response.law = response.black_base ? SpecularLaw::kProportional : SpecularLaw::kAffine;
      return response;
    }
    if (const double deviation = ior_deviation(); deviation <= picture_tolerance(model_)) {
      response.law = SpecularLaw::kIor;
      response.residual = deviation;
    } else if (const auto found = knee()) {
      response.law = SpecularLaw::kClamped;
      response.knee = *found;
      response.residual = ratio_tolerance(model_);
    }
    return response;
  }

 private:
  Radiances take(double alpha, double specular) const {
    return picture_taker_.take(model_, RoleValues{alpha, specular, 0.0});
  }

  // Returns true if pictures are black at specular 0, or at index 1. Returns false if the range does not
  // begin there, because it is then unknown.
  bool black_at_zero() const {
    if (range_.min != 0.0 && range_.min != 1.0) return false;
    return std::ranges::all_of(widths_, [](const WidthProbe& probe) { return is_black(probe.low); });
  }

  double affine_deviation() const {
    double worst = 0.0;
    for (const WidthProbe& probe : widths_)
      worst = std::max(worst, line_deviation(probe.low, probe.high, 0.5, probe.middle));
    return worst;
  }

  // Returns how far pictures are from affine in F0, if the specular of the model is an index of refraction.
  // Compares the pictures in the middle of the range of indices, and in the middle of the range of F0.
  double ior_deviation() const {
    if (range_.min < 1.0) return 1.0;
    const double low = normal_reflectance(range_.min), high = normal_reflectance(range_.max);
    const double middle = normal_reflectance(0.5 * (range_.min + range_.max));
    double worst = 0.0;
    for (const WidthProbe& probe : widths_) {
      const double t = (middle - low) / (high - low);
      const Radiances half = take(probe.alpha, ior_of_reflectance(0.5 * (low + high)));
      worst = std::max({worst, line_deviation(probe.low, probe.high, t, probe.middle),
                        line_deviation(probe.low, probe.high, 0.5, half)});
    }
    return worst;
  }

  // Returns the place of a picture on the line from `low` to `high`, as a fraction, or nothing if it is not
  // on the line.
  std::optional<double> share(const WidthProbe& probe, double specular) const {
    const Radiances picture = take(probe.alpha, specular);
    double product = 0.0, power = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const double whole = static_cast<double>(probe.high[i]) - probe.low[i];
      product += whole * (static_cast<double>(picture[i]) - probe.low[i]);
      power += whole * whole;
    }
    if (!(power > 0.0)) return std::nullopt;
    if (line_deviation(probe.low, probe.high, product / power, picture) > picture_tolerance(model_))
      return std::nullopt;
    return product / power;
  }

  // Returns the knee at one width. It is computed from a picture below the knee, and confirmed by pictures on
  // both sides.
  std::optional<double> knee_at(const WidthProbe& probe) const {
    double step = 0.5 * (range_.max - range_.min);
    std::optional<double> reached = share(probe, range_.min + step);
    for (int halving = 0; reached && *reached > 1.0 - ratio_tolerance(model_); ++halving) {
      if (halving == kMostHalvings) return std::nullopt;
      step *= 0.5;
      reached = share(probe, range_.min + step);
    }
    if (!reached || !(*reached > 0.0)) return std::nullopt;
    const double length = step / *reached;  // distance from the start of the range to the knee
    for (const double distance :
         {0.3 * length, 0.97 * length, 1.03 * length, 0.5 * (length + range_.max - range_.min)}) {
      if (range_.min + distance > range_.max) return std::nullopt;
      const auto found = share(probe, range_.min + distance);
      if (!found || std::fabs(*found - std::min(1.0, distance / length)) > 10.0 * ratio_tolerance(model_))
        return std::nullopt;
    }
    return range_.min + length;
  }

  std::optional<double> knee() const {
    std::optional<double> common;
    for (const WidthProbe& probe : widths_) {
      const auto found = knee_at(probe);
      if (!found) return std::nullopt;
      if (!common) common = found;
      if (std::fabs(*found - *common) > 10.0 * ratio_tolerance(model_) * *common) return std::nullopt;
    }
    return std::round(*common / kRatioTolerance) / (1.0 / kRatioTolerance);
  }

  const PictureTaker& picture_taker_;
  const ModelDescription& model_;
  Range range_;
  std::vector<WidthProbe> widths_;
};

}  // namespace

double picture_tolerance(const ModelDescription& model) {
  return std::max(kPictureTolerance, 2.0 * model.precision);
}

SpecularResponse probe_specular(const PictureTaker& picture_taker, const ModelDescription& model,
                                const Range& alphas) {
  return SpecularProbe(picture_taker, model, alphas).law();
}

Range probe_widths(const PictureTaker& picture_taker, const ModelDescription& model, const Range& alphas) {
  // The peak is proportional to 1 / alpha^2. If the renderer does not clamp the width, the peak changes by
  // twice the step.
  const double step = 1.0 + std::max(kWidthPrecision, 4.0 * picture_tolerance(model));
  if (!(alphas.max > step * step * alphas.min)) return alphas;
  const double full = model.parameter(ParameterRole::kSpecular).range.max;
  const auto responds = [&](double alpha, double neighbour) {
    const Radiances here = picture_taker.take(model, RoleValues{alpha, full, 0.0});
    const Radiances nearby = picture_taker.take(model, RoleValues{neighbour, full, 0.0});
    if (is_black(here) || is_black(nearby)) return false;
    return line_deviation(nearby, here, 0.0, here) > picture_tolerance(model);
  };
  // Bisects between an end that is clamped and a width that is not. This is the middle, or otherwise the
  // other end.
  const double middle = std::sqrt(alphas.min * alphas.max);
  const auto end = [&](double clamped, double other) {
    const double inwards = clamped < other ? step : 1.0 / step;
    if (responds(clamped, clamped * inwards)) return clamped;
    double free = responds(middle, middle / inwards) ? middle : other;
    if (free == other && !responds(other, other / inwards))
      throw input_error(model.name + ": no width from alpha " + number_text(alphas.min) + " to " +
                        number_text(alphas.max) + " changes its picture (the roughness has no effect)");
    while (std::max(free / clamped, clamped / free) > step) {
      const double between = std::sqrt(clamped * free);
      (responds(between, between / inwards) ? free : clamped) = between;
    }
    return free;
  };
  return {end(alphas.min, alphas.max), end(alphas.max, alphas.min)};
}

bool probe_diffuse(const PictureTaker& picture_taker, const ModelDescription& model, const Range& alphas) {
  const Range speculars = model.parameter(ParameterRole::kSpecular).range;
  const double full = model.parameter(ParameterRole::kDiffuse).range.max;
  const auto take = [&](double alpha, double specular, double diffuse) {
    return picture_taker.take(model, RoleValues{alpha, specular, diffuse});
  };
  const Radiances dark = take(alphas.max, speculars.min, 0.0), lit = take(alphas.max, speculars.min, full);
  for (const double alpha : {alphas.min, alphas.max}) {
    const Radiances without = take(alpha, speculars.max, 0.0);
    const Radiances half = take(alpha, speculars.max, 0.5 * full), with = take(alpha, speculars.max, full);
    Radiances expected(without);
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] += lit[i] - dark[i];
    if (line_deviation(expected, with, 1.0, expected) > picture_tolerance(model)) return false;
    if (line_deviation(without, with, 0.5, half) > picture_tolerance(model)) return false;
  }
  return true;
}

bool light_matched(const ModelDescription& source, const ModelDescription& target) {
  return source.has(ParameterRole::kDiffuse) && target.has(ParameterRole::kDiffuse);
}

DiffuseMatch match_diffuse(const PictureTaker& picture_taker, const ModelDescription& source,
                           const ModelDescription& target) {
  const auto diffuse_picture = [&](const ModelDescription& model) {
    const double alpha = std::sqrt(model.alpha.min * model.alpha.max);
    const double dark = model.parameter(ParameterRole::kSpecular).range.min;
    const double full = model.parameter(ParameterRole::kDiffuse).range.max;
    Radiances picture = picture_taker.take(model, RoleValues{alpha, dark, full});
    const Radiances without = picture_taker.take(model, RoleValues{alpha, dark, 0.0});
    for (std::size_t i = 0; i < picture.size(); ++i)
      picture[i] = static_cast<float>((picture[i] - without[i]) / full);
    return picture;
  };
  const Radiances wanted = diffuse_picture(source), given = diffuse_picture(target);
  const double wanted_2 = inner_product(wanted.data(), wanted.data(), wanted.size());
  const double cross = inner_product(wanted.data(), given.data(), wanted.size());
  const double given_2 = inner_product(given.data(), given.data(), given.size());
  if (!(wanted_2 > 0.0) || !(given_2 > 0.0))
    throw input_error(source.name + " to " + target.name + ": a diffuse picture is black");
  const double left = std::max(0.0, wanted_2 - cross * cross / given_2);
  const double scale = cross / given_2;
  const double tolerance = std::max(ratio_tolerance(source), ratio_tolerance(target));
  return {std::fabs(scale - 1.0) < tolerance ? 1.0 : scale, std::sqrt(left / wanted_2)};
}

}  // namespace remap
