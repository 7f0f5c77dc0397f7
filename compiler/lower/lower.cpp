#include "lower/lower.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/number_text.hpp"
#include "lower/approximate.hpp"
#include "lower/interpreter.hpp"
#include "lower/prove.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// The most boxes that one proof, and all proofs of one search, may examine, so that a failing search takes at
// most about two seconds.
constexpr std::size_t kFirstBudget = 2000, kBoxBudget = 6000, kSearchBudget = 12000;

// Converters take the model's own parameter as a float, so the ends of the domain move by some units in the
// last place of alpha or, for glossiness, of 1 - sqrt(alpha).
double room(double alpha) { return 2e-6 * alpha + 1.5e-7 * std::sqrt(alpha); }
double room_below(double alpha) { return alpha - room(alpha); }
double room_above(double alpha) { return alpha + room(alpha); }

ProofDomain proof_domain(const Domain& domain) {
  return {{room_below(domain.alpha.min), room_above(domain.alpha.max)},
          {0.0, domain.specular.max * (1.0 + 2e-6)}};
}

// Whether the samples rise strictly everywhere.
bool rises_with_alpha(const SampleGrid& grid) {
  const std::size_t row = grid.specular.size();
  for (std::size_t i = row; i < grid.values.size(); ++i)
    if (!(grid.values[i] > grid.values[i - row])) return false;
  return true;
}

bool rises_with_specular(const SampleGrid& grid) {
  const std::size_t row = grid.specular.size();
  if (row < 2) return false;
  for (std::size_t i = 0; i < grid.values.size(); ++i)
    if (i % row != 0 && !(grid.values[i] > grid.values[i - 1])) return false;
  return true;
}

// One output of a mapping, and the requirements on its polynomial.
struct LoweredOutput {
  const char* name = "";       // for messages
  const char* unit_text = "";  // after figures in messages
  MappedFunction model;
  ProofDomain domain;      // of the function that is lowered
  bool is_factor = false;  // to be multiplied by specular, which is at most specular_max
  double specular_max = 1.0;
  double tolerance = 0.0;  // of the output, relative to `unit`
  double unit = 1.0;
};

// The polynomial of a Lowered: a factor becomes the coefficient of specular^1.
PiecewisePolynomial completed(const LoweredOutput& wanted, PiecewisePolynomial polynomial) {
  if (wanted.is_factor) polynomial.degrees.insert(polynomial.degrees.begin(), -1);
  return polynomial;
}

// Tries shapes. Bounds refer to the output.
class ShapeSearch {
 public:
  explicit ShapeSearch(const LoweredOutput& wanted)
      : wanted_(wanted),
        finder_(wanted.model, wanted.domain),
        samples_(sample(wanted.model, wanted.domain)),
        rises_with_alpha_(rises_with_alpha(samples_)),
        rises_with_specular_(rises_with_specular(samples_)) {}
  // Whether the polynomial is proven to rise wherever the samples of the model do.
  bool keeps_rising(const LoweredFunction& lowered) const {
    return lowered.rises_with_alpha == rises_with_alpha_ &&
           (wanted_.is_factor || lowered.rises_with_specular == rises_with_specular_);
  }
  ShapeFinder& finder() { return finder_; }
  // The number of boxes that proofs may still examine.
  void set_budget(std::size_t boxes) { budget_ = boxes; }
  bool budget_is_spent() const { return budget_ == 0; }

  // The bound is infinite if the samples already exceed the tolerance, or if the budget is spent.
  // `must_rise`: also if the polynomial does not rise where the model does.
  LoweredFunction operator()(const PolynomialShape& shape, double tolerance, bool must_rise) {
    const double top = wanted_.is_factor ? wanted_.specular_max : 1.0;
    const ProofDomain whole =
        wanted_.is_factor ? ProofDomain{wanted_.domain.alpha, {0.0, top}} : wanted_.domain;
    const PiecewisePolynomial polynomial = approximate(wanted_.model, wanted_.domain, shape);
    LoweredFunction lowered;
    lowered.polynomial = completed(wanted_, polynomial);
    lowered.bound = INFINITY;
    const double rounding = rounding_error(lowered.polynomial, whole);
    lowered.sampled = top * sampled_error(polynomial, samples_);
    closest_ = std::min(closest_, lowered.sampled + rounding);
    if (!(lowered.sampled + rounding <= tolerance)) return lowered;
    lowered.rises_with_alpha = rises_with_alpha_ && proven_rising_with_alpha(polynomial, wanted_.domain);
    lowered.rises_with_specular =
        (wanted_.is_factor || rises_with_specular_) && proven_rising_with_specular(lowered.polynomial, whole);
    if (must_rise && !keeps_rising(lowered)) return lowered;
    const double room = (tolerance - rounding) / top;
    const double target = std::clamp(1.1 * lowered.sampled / top, 0.3 * room, room);
    Proof proof = prove(polynomial, target, kFirstBudget);
    if (!(proof.bound <= room)) proof = prove(polynomial, room, kBoxBudget);
    lowered.bound = top * proof.bound + rounding;
    return lowered;
  }
  // The smallest error that any shape had on the samples.
  double closest() const { return closest_; }

 private:
  Proof prove(const PiecewisePolynomial& polynomial, double target, std::size_t boxes) {
    if (budget_ == 0) return {INFINITY, 0};
    const Proof proof =
        proven_error(wanted_.model, polynomial, wanted_.domain, target, std::min(boxes, budget_));
    budget_ -= std::min(proof.boxes, budget_);
    return proof;
  }

  const LoweredOutput& wanted_;
  ShapeFinder finder_;
  SampleGrid samples_;
  bool rises_with_alpha_ = false, rises_with_specular_ = false;
  std::size_t budget_ = 0;
  double closest_ = INFINITY;
};

// Shares of the tolerance to which series are truncated. Looser ones come first, because truncation bounds
// overestimate; tight ones may find a polynomial that still rises.
constexpr std::size_t kMostNumbers = 2048;  // of the table of one output
constexpr std::array<double, 6> kCuts = {2.8, 2.0, 1.4, 1.0, 0.25, 0.06};

std::size_t table_size(const PolynomialShape& shape) {
  return coefficient_count(shape.degrees) * static_cast<std::size_t>(shape.cell_count);
}

// The cheapest polynomial of the smallest size within the tolerance, preferably one that rises where the
// model does. If none is within the tolerance, the one with the smallest proven bound.
LoweredFunction search(const LoweredOutput& wanted, double tolerance, ShapeSearch* attempt) {
  attempt->set_budget(kSearchBudget);
  const double top = wanted.is_factor ? wanted.specular_max : 1.0;
  LoweredFunction best;
  best.bound = INFINITY;
  for (std::size_t size = 0; size < attempt->finder().size_count() && !(best.bound <= tolerance); ++size)
    for (const double cut : kCuts) {
      const double sought = cut * tolerance / top;
      for (const PolynomialShape& shape : attempt->finder().shapes(sought, size)) {
        if (table_size(shape) > kMostNumbers || !(shape.estimate <= 4.0 * sought)) continue;
        const LoweredFunction lowered = (*attempt)(shape, tolerance, best.bound <= tolerance);
        if (lowered.bound <= tolerance && attempt->keeps_rising(lowered)) return lowered;
        if (lowered.bound < best.bound) best = lowered;
      }
    }
  return best;
}

std::string digits(double value) { return number_text(rounded_up(value, 2)); }

// Searches growing tolerances for the smallest one that can be met, and throws it.
[[noreturn]] void refuse(const LoweredOutput& wanted, const LoweredFunction& best, ShapeSearch* attempt) {
  const std::string found = std::string("lower: ") + wanted.name + " needs more than " +
                            std::to_string(kMostNumbers) + " numbers to stay within " +
                            digits(wanted.tolerance) + wanted.unit_text + "; ";
  constexpr int kTries = 40;
  double reached = std::min(best.bound, 2.0 * attempt->closest()) / wanted.unit;
  double tolerance = 1.5 * wanted.tolerance;
  for (int i = 0; i < kTries && std::isfinite(tolerance * wanted.unit); ++i) {
    if (std::isfinite(reached)) tolerance = std::max(tolerance, reached);
    tolerance = rounded_up(tolerance, 2);
    const LoweredFunction lowered = search(wanted, tolerance * wanted.unit, attempt);
    if (lowered.bound <= tolerance * wanted.unit)
      throw Error(ErrorKind::kNumeric, found + digits(tolerance) + wanted.unit_text + " can be proven");
    reached = lowered.bound / wanted.unit;
    tolerance *= attempt->budget_is_spent() ? 3.0 : 2.0;
  }
  throw Error(ErrorKind::kNumeric, found + "no bound can be proven");
}

LoweredFunction lower_output(const LoweredOutput& wanted) {
  ShapeSearch attempt(wanted);
  const double tolerance = wanted.tolerance * wanted.unit;
  if (!std::isfinite(tolerance))
    throw Error(ErrorKind::kNumeric, std::string("lower: ") + wanted.name +
                                         " is so large that its tolerance " + digits(wanted.tolerance) +
                                         wanted.unit_text + " is not finite");
  LoweredFunction best = search(wanted, tolerance, &attempt);
  if (!(best.bound <= tolerance)) refuse(wanted, best, &attempt);
  return best;
}

template <typename Kind>
LoweredOutput wanted_alpha(const Kind& kind, const MappingKind& mapping, const ProofDomain& domain,
                           const LoweringOptions& options) {
  LoweredOutput alpha;
  alpha.name = "target alpha";
  alpha.model = mapped_function(alpha_depends_on_specular(mapping),
                                [kind](const auto& a, const auto& s) { return target_alpha(kind, a, s); });
  alpha.domain = domain;
  alpha.tolerance = options.alpha_tolerance;
  return alpha;
}

// `limit`: what lies beyond is not looked at, so it is no unit of errors.
template <typename Kind>
LoweredOutput wanted_specular(const Kind& kind, const MappingKind& mapping, const ProofDomain& domain,
                              const std::optional<double>& limit, const LoweringOptions& options) {
  LoweredOutput specular;
  specular.name = "target specular";
  specular.unit_text = " of its largest value";
  specular.is_factor = is_proportional(mapping);  // lowered as its value at specular 1
  specular.model = mapped_function(
      !specular.is_factor, [kind](const auto& a, const auto& s) { return target_specular(kind, a, s); });
  specular.domain = specular.is_factor ? ProofDomain{domain.alpha, {1.0, 1.0}} : domain;
  specular.specular_max = domain.specular.max;
  const double largest =
      sample(specular.model, specular.domain).largest * (specular.is_factor ? domain.specular.max : 1.0);
  if (largest != 0.0) specular.unit = std::min(largest, limit.value_or(largest));
  specular.tolerance = options.specular_tolerance;
  return specular;
}

// Lowers a series of both parameters to the tolerance of `like`.
LoweredSeries lower_series(const LoweredOutput& like, const char* name, const TexelSeries& series) {
  LoweredOutput wanted = like;
  wanted.name = name;
  wanted.is_factor = false;
  wanted.model =
      mapped_function(true, [series](const auto& a, const auto& s) { return series_value(series, a, s); });
  wanted.domain = {{room_below(series.alpha.min), room_above(series.alpha.max)},
                   {series.specular.min * (1.0 - 2e-6), series.specular.max * (1.0 + 2e-6)}};
  return {static_cast<float>(series.alpha.min), static_cast<float>(series.specular.min),
          lower_output(wanted)};
}

// Whether values of the function may pass `limit` on its samples.
bool may_pass(const LoweredOutput& wanted, double limit) {
  const double factor = wanted.is_factor ? wanted.specular_max : 1.0;
  const std::vector<double> values = sample(wanted.model, wanted.domain).values;
  return factor * *std::ranges::max_element(values) + wanted.tolerance * wanted.unit > limit;
}

// Beyond the limit of specular, pictures differ by far more than a width that is off by this times the
// tolerance.
constexpr double kBrightTolerance = 10.0;

constexpr int kSeamSamples = 400;

// The largest difference between regimes in the seams, times the errors of their shares.
void find_seams(const Fit& fit, const ProofDomain& domain, Lowered* lowered) {
  const auto at = [](const Range& range, int i) {
    return range.min + (range.max - range.min) * i / kSeamSamples;
  };
  const auto in_seam = [](double share) { return share > 0.0 && share < 1.0; };
  const double clamped_from = mapping_domain(fit).alpha.max;
  double alpha_gap = 0.0, specular_gap = 0.0;
  for (int i = 0; i <= kSeamSamples; ++i)
    for (int j = 0; j <= kSeamSamples; ++j) {
      const double alpha = at(domain.alpha, i), specular = at(domain.specular, j);
      const TexelWidth width = target_width(fit, alpha, specular);
      if (in_seam(width.bright)) {
        const double clamped = std::min(alpha, clamped_from);
        const double inside = evaluate_mapping(fit.mapping, clamped, specular).alpha;
        const double moved = width.alpha - std::min(inside, fit.regimes.alpha_limit);
        alpha_gap = std::max(alpha_gap, std::fabs(moved) / width.bright);
      }
      if (in_seam(width.wide))
        specular_gap = std::max(specular_gap, std::fabs(target_channel(fit, 1.0, alpha, specular) -
                                                        target_channel(fit, 0.0, alpha, specular)));
    }
  const double limit = fit.regimes.specular_limit.value_or(1.0);
  const double specular_bound =
      std::max(lowered->specular.bound, lowered->wide ? lowered->wide->specular.function.bound : 0.0);
  lowered->specular_seam = specular_gap * lowered->alpha.bound / (kSeam * fit.regimes.alpha_limit);
  lowered->alpha_seam = alpha_gap * (specular_bound + lowered->specular_seam) / (kSeam * limit);
}

}  // namespace

Lowered lower(const MappingKind& mapping, const Domain& domain, const LoweringOptions& options) {
  Fit fit;
  fit.mapping = mapping;
  fit.domain = domain;
  fit.regimes.alpha_limit = INFINITY;
  return lower(fit, options);
}

Lowered lower(const Fit& fit, const LoweringOptions& options) {
  const ProofDomain domain = proof_domain(fit.domain);
  const Regimes& regimes = fit.regimes;
  ProofDomain inside = domain;
  if (regimes.wide) inside.alpha.max = std::min(inside.alpha.max, room_above(regimes.wide->mapping_to));
  const auto [alpha, specular] = std::visit(
      [&](const auto& kind) {
        return std::pair(wanted_alpha(kind, fit.mapping, inside, options),
                         wanted_specular(kind, fit.mapping, inside, regimes.specular_limit, options));
      },
      fit.mapping);
  Lowered lowered;
  lowered.alpha = lower_output(alpha);
  lowered.specular = lower_output(specular);
  if (may_pass(alpha, regimes.alpha_limit)) lowered.alpha_limit = static_cast<float>(regimes.alpha_limit);
  if (regimes.specular_limit && may_pass(specular, *regimes.specular_limit))
    lowered.specular_limit = static_cast<float>(*regimes.specular_limit);
  if (regimes.wide)
    lowered.wide = {static_cast<float>(regimes.wide->mapping_to),
                    lower_series(specular, "target specular of the wide regime", regimes.wide->specular)};
  if (regimes.bright) {
    LoweredOutput bright = alpha;
    bright.tolerance *= kBrightTolerance;
    lowered.bright = lower_series(bright, "target alpha of the bright regime", *regimes.bright);
  }
  if (regimes.wide || regimes.bright) find_seams(fit, domain, &lowered);
  return lowered;
}

}  // namespace remap
