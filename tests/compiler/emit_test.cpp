// The emitter's parts: templates, the polynomial and its bound, layout and determinism.
#include "emit/emit.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "emit/slope_polynomial.hpp"
#include "emit/text_template.hpp"
#include "error.hpp"
#include "files.hpp"
#include "model/fit_json.hpp"
#include "model/interpreter.hpp"

using namespace remapc;

TEST_CASE("template: holes are filled, lines of a value keep the indentation, empty lines vanish") {
  CHECK(fill_template("a @x@ b\n", {{"x", "1"}}) == "a 1 b\n");
  CHECK(fill_template("{\n  @x@\n}\n", {{"x", "one\ntwo\n"}}) == "{\n  one\n  two\n}\n");
  CHECK(fill_template("{\n  @x@\n}\n", {{"x", ""}}) == "{\n}\n");
  CHECK(fill_template("@x@@x@\n", {{"x", "@y@"}}) == "@y@@y@\n");
}

TEST_CASE("template: a hole without value and a value without hole are bugs") {
  CHECK_THROWS_AS(fill_template("@x@\n", {}), std::logic_error);
  CHECK_THROWS_AS(fill_template("x\n", {{"x", "1"}}), std::logic_error);
  CHECK_THROWS_AS(fill_template("@x\n", {{"x", "1"}}), std::logic_error);
}

TEST_CASE("slope polynomial: the proven bound holds at random points of random slopes") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int approximated = 0;
  for (int i = 0; i < 200; ++i) {
    const remap::Parametric form{{1, 0, 0, 0},
                                 unit(random),
                                 4.0 * unit(random) - 2.0,
                                 8.0 * unit(random),
                                 4.0 * unit(random) - 2.0,
                                 10.0 * unit(random)};
    const remap::Range range{0.05 * unit(random), 0.5 + 0.5 * unit(random)};
    const auto polynomial = approximate_slope(form, range, 4e-7, 14);
    if (!polynomial) continue;
    ++approximated;
    CHECK(polynomial->bound <= 4e-7);
    double worst = 0.0;
    for (int j = 0; j < 1000; ++j) {
      const double alpha = range.min + (range.max - range.min) * unit(random);
      double value = 0.0;
      for (std::size_t k = polynomial->coefficients.size(); k-- > 0;)
        value = value * (alpha - polynomial->centre) + polynomial->coefficients[k];
      worst = std::max(worst, std::fabs(value - remap::specular_slope(form, alpha)));
    }
    CHECK(worst <= polynomial->bound);
  }
  CHECK(approximated > 100);
}

TEST_CASE("slope polynomial: none where the degree does not suffice") {
  CHECK_FALSE(
      approximate_slope({{1, 0, 0, 0}, 1.0, -26.0, 86.0, 0.0, 0.0}, {0.01, 1.0}, 4e-7, 14).has_value());
  const auto straight = approximate_slope({{1, 0, 0, 0}, 0.5, 0.25, 0.0, 0.0, 0.0}, {0.0, 1.0}, 4e-7, 14);
  REQUIRE(straight.has_value());
  CHECK(straight->coefficients.size() == 2);
}

TEST_CASE("emit: the same fit gives the same bytes, and the committed header is what its fit gives") {
  const std::string root = REMAP_SOURCE_DIR;
  const remap::Fit fit = remap::load_fit(root + "/fits/mitsuba_ward_to_mitsuba_as.json");
  CHECK(emit_header(fit) == emit_header(fit));
  CHECK(emit_header(fit) == remap::read_file(root + "/generated/mitsuba_ward_to_mitsuba_as.hpp"));
}

TEST_CASE("emit: the header names models, table, errors and licence, and defines no macro but its guard") {
  const remap::Fit fit =
      remap::load_fit(std::string(REMAP_SOURCE_DIR) + "/fits/mitsuba_ward_to_mitsuba_as.json");
  const std::string header = emit_header(fit);
  for (const std::string& part : {fit.source.model, fit.target.model, fit.table.sha256, std::string("MIT-0"),
                                  std::string("remapc emit")})
    CHECK(header.find(part) != std::string::npos);
  std::size_t defines = 0;
  for (std::size_t at = header.find("#define"); at != std::string::npos; at = header.find("#define", at + 1))
    ++defines;
  CHECK(defines == 1);
}

TEST_CASE("emit: a coefficient that is no finite float is refused") {
  remap::Fit fit = remap::load_fit(std::string(REMAP_SOURCE_DIR) + "/fits/mitsuba_ward_to_mitsuba_as.json");
  std::get<remap::Parametric>(fit.mapping).roughness[2] = 1e300;
  CHECK_THROWS_WITH(emit_header(fit), Catch::Contains("not finite"));
}

TEST_CASE("emit: a parameter named as a variable of the header is refused") {
  remap::Fit fit = remap::load_fit(std::string(REMAP_SOURCE_DIR) + "/fits/mitsuba_ward_to_mitsuba_as.json");
  fit.target.specular = "count";
  CHECK_THROWS_WITH(emit_header(fit), Catch::Contains("called count"));
}

TEST_CASE("emit: the registry lists converters in the order of their ids") {
  remap::Fit fit = remap::load_fit(std::string(REMAP_SOURCE_DIR) + "/fits/mitsuba_ward_to_mitsuba_as.json");
  remap::Fit other = fit;
  other.id = "a_to_b";
  CHECK(emit_registry({fit, other}) == emit_registry({other, fit}));
  CHECK(emit_registry({fit, other}).find("std::array<ConverterEntry, 2>") != std::string::npos);
}
