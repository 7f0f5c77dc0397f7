// This file tests the reference interpreter against the formulas as printed in the paper, the domain rule,
// chains of fits that become one fit, inverses of fits, and round trips.
#include "lower/interpreter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "lower/chain.hpp"
#include "lower/fit_file.hpp"
#include "lower/lower.hpp"
#include "remap/error.hpp"
#include "remap/model.hpp"

using namespace remap;

namespace {

Fit ward_to_as() {
  Fit fit;
  fit.id = "w_to_a";
  fit.domain = {{0.05, 1.0}, {0.0, 0.5}};
  // This is appendix A with the erratum of its cubic coefficient. k is written in the form of fit.hpp.
  const double c1 = 512.75, c2 = 0.00057, c3 = 0.398, c4 = 3.12, c0 = -512.13;
  fit.mapping =
      Parametric{{{1.04, -0.388, -0.332, 0.25}}, {{1, {c0 + c1 + c3, -c1 * c2, c2, -c3 * c4, c4, 0.0}}}};
  return fit;
}

}  // namespace

TEST_CASE("interpreter: the parametric kind is section 7 of the paper") {
  const Fit fit = ward_to_as();
  for (const double a : {0.05, 0.3, 0.77, 1.0}) {
    const MappedTexel texel = evaluate_mapping(fit.mapping, a, 0.3);
    CHECK(texel.alpha == Approx(1.04 * a - 0.388 * a * a - 0.332 * a * a * a + 0.25 * a * a * a * a));
    const double k = -512.13 + 512.75 * std::exp(-0.00057 * a) + 0.398 * std::exp(-3.12 * a * a);
    CHECK(texel.specular == Approx(0.3 * k).epsilon(1e-9));
  }
}

TEST_CASE("interpreter: terms of one power add up, a pole is c5 / alpha, rows of roughness count specular") {
  const Parametric form{{{0.5, 0.25}, {0.125}, {0.0, 1.0}},
                        {{0, {0.01, 0.0, 0.0, 0.0, 0.0, 0.0}},
                         {1, {1.0, 0.0, 0.0, 0.0, 0.0, 0.002}},
                         {1, {0.0, 2.0, 0.0, 0.0, 0.0, 0.0}},
                         {3, {0.0, 0.0, 0.0, 3.0, 0.0, 0.0}}}};
  const double a = 0.4, s = 0.7;
  const MappedTexel texel = evaluate_mapping(form, a, s);
  CHECK(texel.alpha == Approx(0.5 * a + 0.25 * a * a + s * 0.125 * a + s * s * a * a));
  CHECK(texel.specular == Approx(0.01 + (1.0 + 0.002 / a + 2.0 * a) * s + 3.0 * a * a * s * s * s));
}

TEST_CASE("interpreter: support vectors are Chang and Lin's sum of kernels over normalised inputs") {
  const KernelExpansion alpha{{{0.2, 2.0, 0.0}}, {0.1, 4.0, 0.0}, 3.0, 0.05, {0.3, 0.9}, {0.7, -0.2}};
  const KernelExpansion both{
      {{0.5, 2.0, 0.25}, {0.0, 5.0, 0.0}}, {0.0, 2.0, 0.0}, 0.5, -1.0, {0.1, 0.2, 0.3, 0.4}, {1.5, -2.5}};
  const double a = 0.4, s = 0.3;
  const MappedTexel texel = evaluate_mapping(Svr{alpha, both}, a, s);
  const double x = (a - 0.2) * 2.0;
  const double sum =
      0.7 * std::exp(-3.0 * (x - 0.3) * (x - 0.3)) - 0.2 * std::exp(-3.0 * (x - 0.9) * (x - 0.9));
  CHECK(texel.alpha == Approx((sum + 0.05) / 4.0 + 0.1));
  const double u = (a / (a + 0.25) - 0.5) * 2.0, v = s * 5.0;
  const auto kernel = [&](double p, double q) {
    return std::exp(-0.5 * ((u - p) * (u - p) + (v - q) * (v - q)));
  };
  CHECK(texel.specular == Approx((1.5 * kernel(0.1, 0.2) - 2.5 * kernel(0.3, 0.4) - 1.0) / 2.0));
}

TEST_CASE("interpreter: a network is its layers, with the activation between them") {
  const Scaling identity;
  const double w = 0.8, b = -0.1, a = 0.4, s = 0.3;
  for (const Activation activation : {Activation::kRelu, Activation::kTanh, Activation::kSilu}) {
    const Network alpha{activation, {identity}, {identity}, {{1, {w, -w}, {b, b}}, {2, {2.0, 3.0}, {0.5}}}};
    const Network both{activation, {identity, identity}, {{0.25, 4.0, 0.0}}, {{2, {1.0, -2.0}, {0.125}}}};
    const auto activated = [&](double x) {
      if (activation == Activation::kRelu) return std::max(x, 0.0);
      return activation == Activation::kTanh ? std::tanh(x) : x / (1.0 + std::exp(-x));
    };
    const MappedTexel texel = evaluate_mapping(Mlp{alpha, both}, a, s);
    CHECK(texel.alpha == Approx(2.0 * activated(w * a + b) + 3.0 * activated(-w * a + b) + 0.5));
    CHECK(texel.specular == Approx((a - 2.0 * s + 0.125) / 4.0 + 0.25));
  }
}

TEST_CASE("interpreter: specular below 0 counts as 0") {
  Fit fit = ward_to_as();
  std::get<Parametric>(fit.mapping)
      .specular.insert(std::get<Parametric>(fit.mapping).specular.begin(),
                       {0, {0.02, 0.0, 0.0, 0.0, 0.0, 0.0}});
  std::array<double, 3> out{}, alone{};
  bool in_domain = true;
  evaluate_texel(fit, 0.5, std::array{0.2, -3.0, 0.0}, out, &in_domain);
  CHECK_FALSE(in_domain);
  evaluate_texel(fit, 0.5, std::array{0.2, 0.0, 0.0}, alone);
  CHECK(out[0] == alone[0]);
  CHECK(out[1] == 0.0);
}

TEST_CASE("interpreter: target alpha is that of the largest channel") {
  Fit fit = ward_to_as();
  std::get<Parametric>(fit.mapping).alpha.push_back({0.3});
  std::array<double, 3> out{};
  const double alpha = evaluate_texel(fit, 0.5, std::array{0.1, 0.4, 0.2}, out);
  CHECK(alpha == Approx(evaluate_mapping(fit.mapping, 0.5, 0.4).alpha));
  // Beyond the domain, the result is the same as at the edge.
  CHECK(evaluate_texel(fit, 0.5, std::array{0.1, 4.0, 0.2}, out) ==
        Approx(evaluate_mapping(fit.mapping, 0.5, 0.5).alpha));
}

TEST_CASE("interpreter: outside the domain the width is clamped and color is kept") {
  const Fit fit = ward_to_as();
  const std::array<double, 3> specular = {2.0, 1.0, 0.1};
  std::array<double, 3> out{};
  bool in_domain = true;
  const double alpha = evaluate_texel(fit, 3.0, specular, out, &in_domain);
  CHECK_FALSE(in_domain);
  CHECK(alpha == Approx(evaluate_mapping(fit.mapping, 1.0, 0.0).alpha));
  CHECK(out[0] / out[1] == Approx(2.0));
  CHECK(out[0] / out[2] == Approx(20.0));
  // Below the domain, both widths go to 0 together.
  CHECK(evaluate_texel(fit, 0.0, specular, out) == 0.0);
  CHECK(evaluate_texel(fit, 0.01, specular, out) ==
        Approx(0.2 * evaluate_mapping(fit.mapping, 0.05, 0.0).alpha));
}

TEST_CASE("interpreter: NaN and infinity anywhere spoil the whole texel") {
  const Fit fit = ward_to_as();
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const auto& texel :
       {std::array{nan, 0.1}, std::array{0.5, nan}, std::array{0.5, infinity}, std::array{-infinity, 0.1}}) {
    std::array<double, 2> out{};
    bool in_domain = true;
    CHECK(std::isnan(evaluate_texel(fit, texel[0], std::array{0.1, texel[1]}, out, &in_domain)));
    CHECK((std::isnan(out[0]) && std::isnan(out[1])));
    CHECK_FALSE(in_domain);
  }
}

TEST_CASE("interpreter: own parameters go through alpha on both sides") {
  Fit fit = ward_to_as();
  fit.source.roughness = RoughnessEncoding::kGlossiness;
  fit.target.roughness = RoughnessEncoding::kExponent;
  std::array<double, 1> out{};
  bool in_domain = false;
  const double exponent = evaluate_texel(fit, 0.4, std::array{0.2}, out, &in_domain);
  const double alpha2 = evaluate_mapping(fit.mapping, 0.36, 0.0).alpha;
  CHECK(exponent == Approx(2.0 / (alpha2 * alpha2) - 2.0));
  CHECK(in_domain);
}

TEST_CASE("convention: every one is its own inverse on (0, 1]") {
  for (const std::string& name : convention_names()) {
    const RoughnessEncoding convention = *encoding_from_name(name);
    for (double alpha = 0.001; alpha <= 1.0; alpha += 0.037)
      CHECK(to_alpha(convention, from_alpha(convention, alpha)) == Approx(alpha).epsilon(1e-12));
  }
  CHECK(from_alpha(RoughnessEncoding::kRoughness, 0.25) == 0.5);
  CHECK(from_alpha(RoughnessEncoding::kExponent, 0.5) == 6.0);
  CHECK(from_alpha(RoughnessEncoding::kGlossiness, 0.25) == 0.5);
  CHECK(from_alpha(RoughnessEncoding::kSquared, 0.5) == 0.25);
  CHECK_FALSE(encoding_from_name("shininess").has_value());
}

namespace {

Fit fit_of(const std::string& source, const std::string& target, Parametric form,
           const Domain& domain = {{0.01, 1.0}, {0.0, 1.0}}) {
  Fit fit;
  fit.source.model = source;
  fit.target.model = target;
  fit.id = converter_id(source, target);
  fit.domain = domain;
  fit.mapping = std::move(form);
  fit.alpha_error = {1e-3, 2e-3, 3e-3};
  fit.specular_error = {2e-3, 4e-3, 6e-3};
  fit.image_error = ErrorFigures{0.1, 0.2, 0.3};
  return fit;
}

// Returns alpha2 = width alpha1 + bend alpha1^2, specular2 = slope specular1 + offset.
Parametric straight(double width, double bend, double slope, double offset = 0.0) {
  Parametric form{{{width, bend}}, {{1, {slope, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
  if (offset != 0.0) form.specular.insert(form.specular.begin(), {0, {offset, 0.0, 0.0, 0.0, 0.0, 0.0}});
  return form;
}

// Returns a mapping whose target alpha grows with specular, as it does if a rim affects the match.
Parametric leaning() { return {{{0.8, 0.1}, {0.05}}, {{1, {0.7, 0.2, 1.5, 0.0, 0.0, 0.0}}}}; }

}  // namespace

TEST_CASE("chain: closed form of two polynomials") {
  const Fit a = fit_of("x/a", "x/b", straight(0.6, 0.2, 0.5)),
            b = fit_of("x/b", "x/c", straight(0.9, 0.05, 0.8));
  const Fit chain = compose({a, b});
  CHECK(chain.id == "x_a_to_x_c");
  CHECK(chain.source.model == "x/a");
  CHECK(chain.target.model == "x/c");
  CHECK(kind_name(chain.mapping) == "compact");
  for (const double alpha : {0.02, 0.3, 1.0}) {
    const double middle = 0.6 * alpha + 0.2 * alpha * alpha;
    const MappedTexel texel = evaluate_mapping(chain.mapping, alpha, 0.4);
    CHECK(texel.alpha == Approx(0.9 * middle + 0.05 * middle * middle).epsilon(3e-4));
    CHECK(texel.specular == Approx(0.16).epsilon(1e-6));
  }
}

TEST_CASE("chain: its domain is where every step stays in its own") {
  const Fit a = fit_of("x/a", "x/b", straight(0.8, 0.0, 0.9));
  const Fit b = fit_of("x/b", "x/c", straight(1.0, 0.0, 1.0), {{0.1, 0.6}, {0.0, 0.45}});
  const Fit chain = compose({a, b});
  CHECK(chain.domain.alpha.min == Approx(0.125).margin(0.003));
  CHECK(chain.domain.alpha.max == Approx(0.75).margin(0.003));
  CHECK(chain.domain.specular.max == Approx(0.5).margin(0.01));
  for (const double alpha : {chain.domain.alpha.min, chain.domain.alpha.max}) {
    const MappedTexel middle = evaluate_mapping(a.mapping, alpha, chain.domain.specular.max);
    CHECK(b.domain.alpha.contains(middle.alpha));
    CHECK(b.domain.specular.contains(middle.specular));
  }
}

TEST_CASE("chain: what cannot be composed is refused with the place") {
  const Fit a = fit_of("x/a", "x/b", straight(0.5, 0.0, 1.0)),
            b = fit_of("x/b", "x/c", straight(1.0, 0.0, 1.0));
  CHECK_THROWS_WITH(compose({a}), Catch::Contains("at least 2"));
  CHECK_THROWS_WITH(compose({b, a}),
                    Catch::Contains("x_b_to_x_c converts to x/c") && Catch::Contains("from x/a"));
  CHECK_THROWS_WITH(compose({a, fit_of("x/b", "x/a", straight(1.0, 0.0, 1.0))}),
                    Catch::Contains("x/a a second time") && Catch::Contains("x_b_to_x_a"));
  Fit rough = b;
  rough.source.roughness = RoughnessEncoding::kRoughness;
  CHECK_THROWS_WITH(compose({a, rough}),
                    Catch::Contains("(alpha, specular)") && Catch::Contains("(roughness,"));
  const Fit far = fit_of("x/b", "x/c", straight(1.0, 0.0, 1.0), {{0.8, 1.0}, {0.0, 1.0}});
  CHECK_THROWS_WITH(compose({a, far}), Catch::Contains("do not meet") && Catch::Contains("x_b_to_x_c") &&
                                           Catch::Contains("0.8 to 1"));
  CHECK_THROWS_WITH(compose({a, b}, "not an id"), Catch::Contains("invalid id"));
}

TEST_CASE("chain: a chain of chains gives what all steps give") {
  const Fit a = fit_of("x/a", "x/b", straight(0.9, 0.0, 0.9)),
            b = fit_of("x/b", "x/c", straight(0.9, 0.0, 0.9)),
            c = fit_of("x/c", "x/d", straight(0.9, 0.0, 0.9));
  const Fit chain = compose({compose({a, b}), c});
  REQUIRE(std::holds_alternative<CompactForm>(chain.mapping));
  CHECK(evaluate_mapping(chain.mapping, 0.5, 1.0).specular == Approx(0.729).epsilon(1e-4));
  CHECK(evaluate_mapping(chain.mapping, 0.5, 1.0).alpha == Approx(0.5 * 0.729).epsilon(1e-4));
}

TEST_CASE("chain: errors of the steps are carried on, image errors add up") {
  const Fit a = fit_of("x/a", "x/b", straight(0.8, 0.0, 0.5)),
            b = fit_of("x/b", "x/c", straight(0.5, 0.0, 2.0));
  const Fit chain = compose({a, b});
  CHECK(chain.alpha_error.rms == Approx(1e-3 * std::hypot(0.5, 1.0)).epsilon(1e-5));
  CHECK(chain.alpha_error.max == Approx(3e-3 * 1.5).epsilon(1e-5));
  CHECK(chain.specular_error.rms == Approx(2e-3 * std::hypot(2.0, 1.0)).epsilon(1e-5));
  CHECK(chain.image_error->rms == Approx(0.2));
  Fit unknown = b;
  unknown.image_error.reset();
  CHECK_FALSE(compose({a, unknown}).image_error.has_value());
}

TEST_CASE("chain: against its steps, with the rules of their domains") {
  const Fit a = fit_of("x/a", "x/b", leaning()), b = fit_of("x/b", "x/c", leaning());
  const Fit chain = compose({a, b});
  CHECK(alpha_depends_on_specular(chain.mapping));
  CHECK_FALSE(is_proportional(chain.mapping));
  const ChainDifference difference = difference_from_steps(chain, {a, b});
  CHECK(difference.alpha < 4e-3);  // one step of an 8-bit map
  CHECK(difference.grey_specular < 1e-4);
  // The second step uses the largest channel of its input, but the chain uses the largest channel of the
  // source. The widths of dark channels therefore differ.
  CHECK(difference.color_specular > 1e-4);
  CHECK(difference.color_specular < 0.05);
}

TEST_CASE("chain: JSON gives it back") {
  const Fit chain =
      compose({fit_of("x/a", "x/b", leaning()), fit_of("x/b", "x/c", straight(0.9, 0.05, 0.8, 0.01))});
  CHECK(fit_from_json(fit_to_json(chain), "chain.json") == chain);
}

TEST_CASE("inverse: back to where it came from, and nowhere else") {
  Fit fit = fit_of("x/a", "x/b", leaning());
  fit.domain = {{0.01, 1.0}, {0.0, 1.0}};
  for (const double alpha : {0.01, 0.2, 0.77, 1.0})
    for (const double specular : {0.01, 0.5, 1.0}) {
      const auto back = inverse(fit, evaluate_mapping(fit.mapping, alpha, specular));
      REQUIRE(back.has_value());
      CHECK(back->alpha == Approx(alpha).epsilon(1e-9));
      CHECK(back->specular == Approx(specular).epsilon(1e-9));
    }
  CHECK_FALSE(inverse(fit, {0.99, 0.1}).has_value());   // wider than any result of the fit
  CHECK_FALSE(inverse(fit, {0.001, 0.1}).has_value());  // narrower than any result of the fit
  CHECK_FALSE(inverse(fit, {0.3, 0.9}).has_value());    // brighter than the width allows
  fit.mapping = straight(1.0, 0.0, 0.5, 0.1);
  CHECK_FALSE(inverse(fit, {0.3, 0.05}).has_value());  // darker than black
}

TEST_CASE("round trip: an inverse comes back, another way back does not") {
  const Fit there = fit_of("x/a", "x/b", straight(0.8, 0.0, 0.5));
  const RoundTrip same = round_trip(there, fit_of("x/b", "x/a", straight(1.25, 0.0, 2.0)));
  CHECK(returns(same));
  CHECK(same.alpha_p99 < 1e-12);
  CHECK(same.specular_p99 < 1e-12);
  CHECK(same.share > 0.95);
  const RoundTrip off = round_trip(there, fit_of("x/b", "x/a", straight(1.2, 0.0, 2.0)));
  CHECK_FALSE(returns(off));
  CHECK(off.alpha_median == Approx(0.04));
  CHECK(off.specular_median < 1e-12);
  const Fit far = fit_of("x/b", "x/a", straight(1.25, 0.0, 2.0), {{0.9, 1.0}, {0.0, 1.0}});
  CHECK(round_trip(there, far).share == 0.0);
  CHECK_FALSE(returns(round_trip(there, far)));
}
