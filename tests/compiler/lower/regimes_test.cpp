// Fits at the limits of their targets, against a conversion in closed form.
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "lower/chain.hpp"
#include "lower/interpreter.hpp"
#include "lower/inverse.hpp"
#include "support/made_regimes.hpp"

using namespace remap;

namespace {

constexpr int kSteps = 200;

double at(int i) { return 0.01 + 0.99 * i / kSteps; }

bool in_seam(const Fit& fit, double alpha, double specular) {
  const auto within = [](double value, double limit) {
    return value > limit && value < limit * (1.0 + kSeam);
  };
  return within(1.5 * std::min(alpha, made_regimes::kMappingTo), fit.regimes.alpha_limit) ||
         within(made_regimes::free_specular(alpha, specular), *fit.regimes.specular_limit);
}

}  // namespace

TEST_CASE("regimes: each answers where it holds, and seams stay between neighbours") {
  const Fit fit = made_regimes::fit();
  std::array<int, 4> seen{};
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double alpha = at(i), specular = static_cast<double>(j) / kSteps;
      const MappedTexel found = evaluate_fit(fit, alpha, specular),
                        exact = made_regimes::exact(alpha, specular);
      const double margin = in_seam(fit, alpha, specular) ? 2e-3 : 1e-12;
      INFO(alpha << " " << specular);
      CHECK(found.alpha == Approx(exact.alpha).margin(margin));
      CHECK(found.specular == Approx(exact.specular).margin(margin));
      ++seen[static_cast<std::size_t>(made_regimes::place(alpha, specular))];
    }
  for (const int count : seen) CHECK(count > 500);
}

TEST_CASE("regimes: results are continuous even where regimes disagree") {
  Fit fit = made_regimes::fit();
  fit.regimes.wide->specular.coefficients[0][0] += 0.02;
  fit.regimes.bright->coefficients[0][0] += 0.02;
  // The seam spreads a step of .02 over .005 of a limit: 4 times the step of the parameter, and its slope.
  constexpr double kStep = 1e-4, kMost = 12.0 * kStep;
  for (const double fixed : {0.03, 0.3, 0.59, 0.62, 0.66, 0.8, 1.0}) {
    MappedTexel by_alpha = evaluate_fit(fit, 0.01, fixed), by_specular = evaluate_fit(fit, fixed, 0.0);
    for (double moving = kStep; moving <= 1.0; moving += kStep) {
      const MappedTexel alpha = evaluate_fit(fit, std::max(moving, 0.01), fixed),
                        specular = evaluate_fit(fit, fixed, moving);
      CHECK(std::fabs(alpha.alpha - by_alpha.alpha) < kMost);
      CHECK(std::fabs(alpha.specular - by_alpha.specular) < kMost);
      CHECK(std::fabs(specular.alpha - by_specular.alpha) < kMost);
      CHECK(std::fabs(specular.specular - by_specular.specular) < kMost);
      by_alpha = alpha;
      by_specular = specular;
    }
  }
}

TEST_CASE("regimes: no texel leaves what the target takes, in any convention") {
  for (const auto convention : {RoughnessConvention::kAlpha, RoughnessConvention::kRoughness,
                                RoughnessConvention::kGlossiness, RoughnessConvention::kExponent}) {
    Fit fit = made_regimes::fit();
    fit.target.roughness = convention;
    fit.regimes.bright->coefficients[0][0] += 0.5;
    for (int i = 0; i <= kSteps; ++i)
      for (const double specular : {0.0, 0.3, 0.7, 1.0}) {
        const std::array<double, 3> in = {specular, 0.5 * specular, 0.0};
        std::array<double, 3> out{};
        const double width = evaluate_texel(fit, at(i), in, out);
        CHECK(to_alpha(convention, width) <= made_regimes::kAlphaLimit * (1.0 + 1e-12));
        for (const double channel : out) {
          CHECK(channel >= 0.0);
          CHECK(channel <= made_regimes::kSpecularLimit);
        }
      }
  }
}

TEST_CASE("regimes: a colour is mapped in the regime of its largest channel") {
  const Fit fit = made_regimes::fit();
  const std::array<double, 3> in = {0.8, 0.2, 0.1};
  std::array<double, 3> out{};
  CHECK(evaluate_texel(fit, 0.8, in, out) == Approx(made_regimes::bright_alpha(0.8, 0.8)));
  for (std::size_t c = 0; c < in.size(); ++c)
    CHECK(out[c] == Approx(std::min(made_regimes::free_specular(0.8, in[c]), 1.0)));
}

TEST_CASE("regimes: is_inside tells the mapping alone from its limits") {
  const Fit fit = made_regimes::fit();
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double alpha = at(i), specular = static_cast<double>(j) / kSteps;
      const bool inside =
          1.5 * alpha < made_regimes::kAlphaLimit && 1.6 * specular < made_regimes::kSpecularLimit;
      CHECK(is_inside(fit, alpha, specular) == inside);
    }
}

TEST_CASE("regimes: a chain covers what stays inside the limits of its first steps") {
  const Fit there = made_regimes::fit();
  Fit on = made_regimes::fit();
  on.source.model = "x/b";
  on.target.model = "x/c";
  on.mapping = Parametric{{{0.5}}, {{1, {0.5, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
  on.regimes = {};
  const Fit chain = compose({there, on});
  CHECK(chain.domain.alpha.max == Approx(made_regimes::kWideFrom).margin(3e-3));
  CHECK(chain.domain.specular.max == Approx(made_regimes::kBrightFrom).margin(0.02));
  CHECK(evaluate_fit(chain, 0.4, 0.5).alpha == Approx(0.3));
  CHECK(evaluate_fit(chain, 0.4, 0.5).specular == Approx(0.4));
}

TEST_CASE("regimes: the inverse finds what lies inside, and nothing for a width of no source") {
  const Fit fit = made_regimes::fit();
  const auto found = inverse(fit, {0.75, 0.8});
  REQUIRE(found.has_value());
  CHECK(found->alpha == Approx(0.5));
  CHECK(found->specular == Approx(0.5));
  CHECK_FALSE(inverse(fit, {0.95, 0.5}).has_value());
}
