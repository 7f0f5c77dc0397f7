// Lowering random models: what a Lowered says of itself holds, or the refusal says what would.
#include "lower/lower.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <regex>
#include <set>

#include <catch2/catch.hpp>

#include "core/number_text.hpp"
#include "lower/evaluate.hpp"
#include "lower/interpreter.hpp"
#include "lower/prove.hpp"
#include "remap/error.hpp"
#include "support/build_speed.hpp"
#include "support/campaign.hpp"
#include "support/made_regimes.hpp"
#include "support/random_models.hpp"

using namespace remap;

namespace {

constexpr int kPoints = kSlowBuild ? 5000 : 100000;

// A texel that a converter may meet: floats within the domain.
struct Texel {
  float alpha, specular;
};

// The alphas around every joint of cells, and the ends of the domain.
std::vector<float> critical_alphas(const PiecewisePolynomial& polynomial, const Domain& domain) {
  const float low = static_cast<float>(domain.alpha.min), high = static_cast<float>(domain.alpha.max);
  std::vector<float> alphas = {low, high, std::nextafter(low, high), std::nextafter(high, low)};
  for (int cell = 1; cell < polynomial.cell_count; ++cell) {
    float alpha = static_cast<float>(cell_begin(polynomial, cell));
    for (int i = 0; i < 4; ++i) alpha = std::nextafter(alpha, 0.0f);
    for (int i = 0; i < 8; ++i) {
      if (alpha >= low && alpha <= high) alphas.push_back(alpha);
      alpha = std::nextafter(alpha, 2.0f);
    }
  }
  return alphas;
}

std::vector<Texel> texels(const Lowered& lowered, const Domain& domain, std::uint64_t seed, int count) {
  const float top = static_cast<float>(domain.specular.max);
  std::vector<Texel> all;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const PiecewisePolynomial* polynomial : {&lowered.alpha.polynomial, &lowered.specular.polynomial})
    for (const float alpha : critical_alphas(*polynomial, domain))
      for (const float specular : {0.0f, top, std::nextafter(top, 0.0f), 0.5f * top, 1e-42f})
        all.push_back({alpha, std::min(specular, top)});
  const float low = static_cast<float>(domain.alpha.min), high = static_cast<float>(domain.alpha.max);
  for (int i = 0; i < count; ++i) {
    const double q = share(random);  // even in alpha, or in its logarithm: curves bend most near 0
    const double alpha = i % 4 == 0 ? domain.alpha.min * std::pow(domain.alpha.max / domain.alpha.min, q)
                                    : domain.alpha.min + (domain.alpha.max - domain.alpha.min) * q;
    all.push_back({std::clamp(static_cast<float>(alpha), low, high),
                   std::min(static_cast<float>(domain.specular.max * share(random)), top)});
  }
  return all;
}

// The largest |float polynomial - interpreter|, as a share of the bound. The interpreter rounds too.
struct Worst {
  double alpha = 0.0, specular = 0.0;
};
Worst worst_share(const RandomModel& model, const Lowered& lowered, const std::vector<Texel>& points) {
  Worst worst;
  const auto include = [](double* largest, const LoweredFunction& function, const Texel& t, double expected) {
    const double found = static_cast<double>(value(function.polynomial, t.alpha, t.specular));
    const double share = std::fabs(found - expected) / function.bound;
    *largest = std::max(*largest, std::isnan(share) ? INFINITY : share);
  };
  for (const Texel& t : points) {
    const MappedTexel expected =
        evaluate_mapping(model.mapping, static_cast<double>(t.alpha), static_cast<double>(t.specular));
    include(&worst.alpha, lowered.alpha, t, expected.alpha);
    include(&worst.specular, lowered.specular, t, expected.specular);
  }
  return worst;
}

// The sum of the magnitudes of a cell's terms, |u| = 1/2.
double magnitude_in_cell(const PiecewisePolynomial& polynomial, int cell, double distance) {
  std::size_t k = static_cast<std::size_t>(cell) * polynomial.coefficients_a_cell();
  double sum = 0.0, power = 1.0;
  for (const int degree : polynomial.degrees) {
    for (int i = 0; i <= degree; ++i)
      sum += power * std::pow(0.5, i) * std::fabs(static_cast<double>(polynomial.coefficients[k++]));
    power *= distance;
  }
  return sum;
}

// Neighbours meet at their joint: as closely as floats for coefficients allow, or ten times closer than the
// bound, which a joint that moves with `scale` and `start` rounded takes where a domain is tiny.
void check_continuity(const LoweredFunction& function, const Domain& domain) {
  constexpr double kUnit = 6e-8;
  const PiecewisePolynomial& polynomial = function.polynomial;
  const double middle = static_cast<double>(polynomial.middle);
  const double distance = std::max(domain.specular.max - middle, middle);
  for (int cell = 0; cell + 1 < polynomial.cell_count; ++cell) {
    const double joint = cell_begin(polynomial, cell + 1);
    for (const double share : {0.0, 0.3, 1.0}) {
      const double specular = share * domain.specular.max;
      const double step = value_in_cell(polynomial, cell + 1, joint, specular) -
                          value_in_cell(polynomial, cell, joint, specular);
      const double rounding = 2.0 * kUnit * magnitude_in_cell(polynomial, cell, distance);
      CHECK(std::fabs(step) <= std::max(rounding, 0.1 * function.bound));
    }
  }
}

// Values in floats along a line never fall by more than twice the rounding; in one cell, in doubles, they
// rise.
void check_rising(const LoweredFunction& function, const Domain& domain) {
  const PiecewisePolynomial& polynomial = function.polynomial;
  const double rounding = rounding_error(polynomial, {domain.alpha, {0.0, domain.specular.max}});
  constexpr int kSteps = 400;
  const auto along = [&](bool by_alpha, double other) {
    double last = -INFINITY, last_exact = -INFINITY;
    int last_cell = -1;
    for (int i = 0; i <= kSteps; ++i) {
      const double q = static_cast<double>(i) / kSteps;
      const auto at = [](const Range& range, double share) {
        return static_cast<float>(range.min + (range.max - range.min) * share);
      };
      const float alpha = at(domain.alpha, by_alpha ? q * q : other);
      const float specular = at({0.0, domain.specular.max}, by_alpha ? other : q);
      const double found = static_cast<double>(value(polynomial, alpha, specular));
      const int cell = cell_of(polynomial, static_cast<double>(alpha));
      const double exact =
          value_in_cell(polynomial, cell, static_cast<double>(alpha), static_cast<double>(specular));
      if (!(found >= last - 2.0 * rounding)) FAIL_CHECK("falls from " << last << " to " << found);
      if (cell == last_cell && !(exact >= last_exact - 1e-6 * rounding))
        FAIL_CHECK("falls within a cell from " << last_exact << " to " << exact);
      last = found;
      last_exact = exact;
      last_cell = cell;
    }
  };
  for (const double other : {0.1, 0.6, 1.0}) {
    if (function.rises_with_alpha) along(true, other);
    if (function.rises_with_specular) along(false, other);
  }
}

// The bound that a refusal states is taken as the tolerance, until both outputs are met.
std::optional<Lowered> lowered_as_stated(const RandomModel& model, LoweringOptions options, int* refusals) {
  static const std::regex kStated("; ([0-9.e+-]*[0-9])( of its largest value)? can be proven");
  for (*refusals = 0; *refusals <= 2; ++*refusals) {
    try {
      return lower(model.mapping, model.domain, options);
    } catch (const Error& error) {
      const std::string message = error.what();
      CHECK(error.kind() == ErrorKind::kNumeric);
      std::smatch stated;
      INFO(message);
      REQUIRE(std::regex_search(message, stated, kStated));
      const double bound = *parse_number(stated[1].str());
      const bool of_alpha = message.find("target alpha") != std::string::npos;
      double& tolerance = of_alpha ? options.alpha_tolerance : options.specular_tolerance;
      CHECK(bound > tolerance);
      tolerance = bound;
    }
  }
  return std::nullopt;
}

LoweringOptions random_options(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  LoweringOptions options;
  if (share(random) < 0.4) return options;
  options.alpha_tolerance = std::pow(10.0, -6.0 + 5.0 * share(random));
  options.specular_tolerance = std::pow(10.0, -6.0 + 5.0 * share(random));
  return options;
}

void check_lowered(const RandomModel& model, const Lowered& lowered, std::uint64_t seed, Worst* worst) {
  const Worst found = worst_share(model, lowered, texels(lowered, model.domain, seed, kPoints));
  CHECK(found.alpha <= 1.0);
  CHECK(found.specular <= 1.0);
  worst->alpha = std::max(worst->alpha, found.alpha);
  worst->specular = std::max(worst->specular, found.specular);
  for (const LoweredFunction* function : {&lowered.alpha, &lowered.specular}) {
    CHECK(function->sampled <= function->bound);
    check_continuity(*function, model.domain);
    check_rising(*function, model.domain);
  }
}

// At least `share_met` of the models can be had within the tolerance.
void check_kind(const std::string& kind, int models = campaign_length(200), double share_met = 0.6) {
  int met = 0, rising = 0;
  double slowest = 0.0;
  Worst worst;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(models); ++seed) {
    INFO(kind << " " << seed);
    const RandomModel model = random_model(kind, seed);
    const LoweringOptions options = random_options(seed);
    int refusals = 0;
    std::optional<Lowered> lowered;
    slowest = std::max(slowest, seconds_of([&] { lowered = lowered_as_stated(model, options, &refusals); }));
    REQUIRE(lowered.has_value());
    met += refusals == 0 ? 1 : 0;
    rising += lowered->alpha.rises_with_alpha || lowered->specular.rises_with_specular ? 1 : 0;
    check_lowered(model, *lowered, seed, &worst);
    if (refusals == 0 && seed % 10 == 0) CHECK(lower(model.mapping, model.domain, options) == *lowered);
  }
  std::cout << kind << ": " << met << " of " << models << " models met the tolerance, " << rising
            << " rise; worst error over bound " << worst.alpha << " and " << worst.specular
            << "; slowest lowering " << slowest << " s\n";
  // Most are not refused, and the bounds are no larger than they have to be: the test is not empty.
  CHECK(met >= share_met * models);
  CHECK(rising >= models / 20);
  CHECK(worst.alpha > 0.5);
  CHECK(worst.specular > 0.5);
}

}  // namespace

TEST_CASE("lowered parametric fits: random ones keep their proven bound", "[slow][campaign]") {
  check_kind("parametric");
}
TEST_CASE("lowered sums of Gaussians: random ones keep their proven bound", "[slow][campaign]") {
  check_kind("svr");
}
TEST_CASE("lowered networks: random ones keep their proven bound", "[slow][campaign]") { check_kind("mlp"); }
TEST_CASE("lowered series: random ones keep their proven bound", "[slow][campaign]") { check_kind("series"); }
TEST_CASE("lowered chains: random ones keep their proven bound", "[slow][campaign]") {
  check_kind("chain", campaign_length(200) / 5,
             0.4);  // each takes as long as its steps and all their products
}

TEST_CASE("lower: a fit with regimes is within its bounds in all of them and in the seams") {
  const Fit fit = made_regimes::fit();
  const Lowered lowered = lower(fit);
  REQUIRE(lowered.wide.has_value());
  REQUIRE(lowered.bright.has_value());
  CHECK(lowered.alpha_limit == static_cast<float>(made_regimes::kAlphaLimit));
  CHECK(lowered.specular_limit == static_cast<float>(made_regimes::kSpecularLimit));
  CHECK(lowered.alpha_bound() < 1e-3);
  CHECK(lowered.specular_bound() < 1e-3);
  Fit bounded = fit;
  bounded.regimes.alpha_limit = bounded.regimes.specular_limit.emplace(3.0);  // out of reach
  bounded.regimes.wide.reset();
  bounded.regimes.bright.reset();
  CHECK_FALSE(lower(bounded).has_limits());
}
