// This file tests the reference interpreter against the formulas as printed in the paper, and the domain
// rule.
#include "lower/interpreter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

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
