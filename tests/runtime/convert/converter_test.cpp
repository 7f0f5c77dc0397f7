// This file tests converters by their interface. Compiled converters are tested in the domain of their fits,
// and the interpreted converter is compared with the interpreter.
#include "remap/converter.hpp"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "lower/interpreter.hpp"
#include "remap/error.hpp"
#include "remap/shipped_converters.hpp"
#include "runtime/convert/texel_rows.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"

using namespace remap;

TEST_CASE("converter: the interpreted one gives the interpreter's values") {
  const Fit fit = example_fit();
  const auto converter = make_interpreted_converter(fit);
  const std::array<float, 4> roughness = {0.1f, 0.7f, 3.0f, NAN};
  const std::array<float, 4> red = {0.1f, 0.2f, 0.3f, 0.1f}, green = {0.3f, 2.0f, 0.1f, 0.1f},
                             blue = {0.0f, 0.1f, 0.4f, 0.1f};
  std::array<float, 4> roughness_out{}, red_out{}, green_out{}, blue_out{};
  const std::array<const float*, 3> in = {red.data(), green.data(), blue.data()};
  const std::array<float*, 3> out = {red_out.data(), green_out.data(), blue_out.data()};
  CHECK(converter->convert(4, roughness.data(), in, roughness_out.data(), out) == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<double, 3> specular = {red[i], green[i], blue[i]};
    std::array<double, 3> expected{};
    const double width = evaluate_texel(fit, static_cast<double>(roughness[i]), specular, expected);
    CHECK(roughness_out[i] == static_cast<float>(width));
    CHECK(red_out[i] == static_cast<float>(expected[0]));
    CHECK(green_out[i] == static_cast<float>(expected[1]));
    CHECK(blue_out[i] == static_cast<float>(expected[2]));
  }
  CHECK(std::isnan(roughness_out[3]));
  CHECK(std::isnan(green_out[3]));
}

TEST_CASE("converter: an output row may be its input row") {
  for (const auto& converter : shipped_converters()) {
    std::array<float, 2> roughness = {0.2f, 0.9f}, specular = {0.1f, 0.3f}, roughness_out{}, specular_out{};
    const std::array<const float*, 1> in = {specular.data()};
    const std::array<float*, 1> apart = {specular_out.data()}, same = {specular.data()};
    converter->convert(2, roughness.data(), in, roughness_out.data(), apart);
    converter->convert(2, roughness.data(), in, roughness.data(), same);
    CHECK(roughness == roughness_out);
    CHECK(specular == specular_out);
  }
}

TEST_CASE("converter: every instruction set computes the same bits", "[slow]") {
  const auto& baseline = shipped_converters(InstructionSet::kBaseline);
  for (const InstructionSet set : instruction_sets()) {
    const auto& converters = shipped_converters(set);
    REQUIRE(converters.size() == baseline.size());
    for (std::size_t i = 0; i < converters.size(); ++i) {
      INFO(converters[i]->info().id << " on " << instruction_set_name(set));
      CHECK(converters[i]->info().instructions == set);
      CHECK(converters[i]->self_test());
      CHECK(same_bits(*converters[i], *baseline[i], odd_and_random_texels(baseline[i]->info(), 10000)));
    }
  }
}

TEST_CASE("converter: compiled ones are sorted, tested and found by their models") {
  std::string last;
  for (const auto& converter : shipped_converters()) {
    const ConverterInfo& info = converter->info();
    CHECK(last < info.id);
    last = info.id;
    CHECK(converter->self_test());
    const ConverterInfo& found = find_converter(info.source.model, info.target.model).info();
    CHECK(found.source == info.source);
    CHECK(found.target == info.target);
    CHECK(info.roughness.min < info.roughness.max);
    CHECK(info.image_rms_error.value_or(1.0) > 0.0);
    CHECK(info.steps.empty());
  }
  CHECK_FALSE(shipped_converters().empty());
}

TEST_CASE("converter: a pair that no converter joins is refused") {
  CHECK_THROWS_WITH(
      find_converter("mitsuba/ward", "mitsuba/sa"),
      "mitsuba/ward to mitsuba/sa: no converter joins these two models directly (search for a path "
      "instead)");
}

TEST_CASE("converter: two specular channels are refused") {
  const std::array<float, 1> row = {0.5f};
  std::array<float, 1> out{};
  const std::array<const float*, 2> in = {row.data(), row.data()};
  const std::array<float*, 2> specular_out = {out.data(), out.data()};
  for (const auto& converter : shipped_converters())
    CHECK_THROWS_AS(converter->convert(1, row.data(), in, out.data(), specular_out), Error);
}
