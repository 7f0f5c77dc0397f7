// The reference interpreter against the formulas as the paper prints them, and the domain rule.
#include "model/interpreter.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "model/convention.hpp"

using namespace remap;

namespace {

Fit ward_to_as() {
  Fit fit;
  fit.id = "w_to_a";
  fit.domain = {{0.05, 1.0}, {0.0, 0.5}};
  // Appendix A with the erratum of its cubic coefficient; k in the form of fit.hpp.
  const double c1 = 512.75, c2 = 0.00057, c3 = 0.398, c4 = 3.12, c0 = -512.13;
  fit.mapping = Parametric{{1.04, -0.388, -0.332, 0.25}, c0 + c1 + c3, -c1 * c2, c2, -c3 * c4, c4};
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
    const double h = 1e-6;
    const double difference =
        (evaluate_mapping(fit.mapping, a + h, 0).alpha - evaluate_mapping(fit.mapping, a - h, 0).alpha) /
        (2 * h);
    CHECK(roughness_derivative(fit.mapping, a) == Approx(difference).epsilon(1e-6));
  }
}

TEST_CASE("interpreter: outside the domain the width is held and colour is kept") {
  const Fit fit = ward_to_as();
  const std::array<double, 3> specular = {2.0, 1.0, 0.1};
  std::array<double, 3> out{};
  bool in_domain = true;
  const double alpha = evaluate_texel(fit, 3.0, specular, out, &in_domain);
  CHECK_FALSE(in_domain);
  CHECK(alpha == Approx(evaluate_mapping(fit.mapping, 1.0, 0.0).alpha));
  CHECK(out[0] / out[1] == Approx(2.0));
  CHECK(out[0] / out[2] == Approx(20.0));
  CHECK(evaluate_texel(fit, 0.0, specular, out) == Approx(evaluate_mapping(fit.mapping, 0.05, 0.0).alpha));
}

TEST_CASE("interpreter: NaN in the width spoils all, in a channel only that channel") {
  const Fit fit = ward_to_as();
  std::array<double, 2> out{};
  CHECK(std::isnan(evaluate_texel(fit, NAN, std::array{0.1, 0.2}, out)));
  CHECK((std::isnan(out[0]) && std::isnan(out[1])));
  bool in_domain = true;
  CHECK(std::isfinite(evaluate_texel(fit, 0.5, std::array{0.1, static_cast<double>(NAN)}, out, &in_domain)));
  CHECK(std::isfinite(out[0]));
  CHECK(std::isnan(out[1]));
  CHECK_FALSE(in_domain);
}

TEST_CASE("interpreter: own parameters go through alpha on both sides") {
  Fit fit = ward_to_as();
  fit.source.roughness = RoughnessConvention::kGlossiness;
  fit.target.roughness = RoughnessConvention::kExponent;
  std::array<double, 1> out{};
  bool in_domain = false;
  const double exponent = evaluate_texel(fit, 0.4, std::array{0.2}, out, &in_domain);
  const double alpha2 = evaluate_mapping(fit.mapping, 0.36, 0.0).alpha;
  CHECK(exponent == Approx(2.0 / (alpha2 * alpha2) - 2.0));
  CHECK(in_domain);
}

TEST_CASE("convention: every one is its own inverse on (0, 1]") {
  for (const std::string& name : convention_names()) {
    const RoughnessConvention convention = *convention_from_name(name);
    for (double alpha = 0.001; alpha <= 1.0; alpha += 0.037)
      CHECK(to_alpha(convention, from_alpha(convention, alpha)) == Approx(alpha).epsilon(1e-12));
  }
  CHECK(from_alpha(RoughnessConvention::kRoughness, 0.25) == 0.5);
  CHECK(from_alpha(RoughnessConvention::kExponent, 0.5) == 6.0);
  CHECK(from_alpha(RoughnessConvention::kGlossiness, 0.25) == 0.5);
  CHECK_FALSE(convention_from_name("shininess").has_value());
}
