// This file tests fits that were not compiled: their forms against the interpreter, on every instruction set.
#include <cmath>

#include <catch2/catch.hpp>

#include "lower/interpreter.hpp"
#include "lower/lower.hpp"
#include "runtime/convert/texel_rows.hpp"
#include "stages/stage.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"
#include "support/random_models.hpp"

using namespace remap;

namespace {

// Returns a mapping in which alpha and specular both depend on both inputs. `gamma` decides how many terms it
// needs.
Svr curved(double gamma) {
  const KernelExpansion alpha{{{0.0, 1.0, 0.0}, {0.0, 2.0, 0.0}}, {0.0, 1.0, 0.0},  gamma, 0.4,
                              {0.1, 0.2, 0.6, 0.9, 0.9, 0.1},     {-0.2, 0.1, 0.15}};
  const KernelExpansion specular{{{0.0, 1.0, 0.0}, {0.0, 2.0, 0.0}}, {0.0, 2.0, 0.0}, gamma, 0.3,
                                 {0.3, 0.1, 0.5, 0.8, 1.0, 0.6},     {0.3, -0.2, 0.1}};
  return {alpha, specular};
}

// Returns fits with every convention on either side, with few and many terms, and random forms with limits
// and hinges.
const std::vector<Fit>& fits() {
  static const std::vector<Fit> all = [] {
    std::vector<Fit> made;
    Fit many = example_fit();
    many.domain.alpha.min = many.domain.specular.min = 0.2;
    many.mapping = curved(2.0);
    made.push_back(lowered_fit(many));
    many.mapping = made.back().converter->form;  // lowered only once, because this takes seconds
    for (const std::string& name : convention_names()) {
      Fit fit = example_fit();
      fit.source.roughness = encoding_from_name(name).value();
      made.push_back(lowered_fit(fit));
      many.source.roughness = many.target.roughness = fit.source.roughness;
      made.push_back(lowered_fit(many));
    }
    for (std::uint64_t seed = 0; seed < 24; ++seed)
      if (const std::optional<Fit> fit = random_form_fit(seed)) made.push_back(lowered_fit(*fit));
    REQUIRE(made.size() > 2 * convention_names().size() + 6);
    return made;
  }();
  return all;
}

// This allows four units in the last place twice: once for the parameters as floats, once for the scale of a
// texel.
constexpr double kRounding = 1e-6;

void check_texel(const Fit& fit, const TestTexels& in, const TestTexels& out, std::size_t i) {
  const ConverterData& lowered = *fit.converter;
  std::array<double, 3> specular{}, expected{};
  double largest = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    specular[c] = static_cast<double>(in.specular[c][i]);
    if (std::isfinite(specular[c])) largest = std::max(largest, specular[c]);
  }
  const double width = evaluate_texel(fit, static_cast<double>(in.roughness[i]), specular, expected);
  INFO("roughness " << in.roughness[i] << ", specular " << specular[0] << " " << specular[1] << " "
                    << specular[2]);
  CHECK(std::isnan(out.roughness[i]) == std::isnan(width));
  if (!std::isnan(width)) {
    const double alpha = to_alpha(fit.target.roughness, static_cast<double>(out.roughness[i]));
    CHECK(std::fabs(alpha - to_alpha(fit.target.roughness, width)) <= lowered.alpha_bound + kRounding);
  }
  const double scale = std::max(1.0, largest / specular_range(fit).max);
  for (std::size_t c = 0; c < 3; ++c) {
    const double mapped = static_cast<double>(out.specular[c][i]);
    if (std::isfinite(expected[c]))
      CHECK(std::fabs(mapped - expected[c]) <=
            scale * (lowered.specular_bound + kRounding) + kRounding * std::fabs(expected[c]));
    else
      CHECK((mapped == expected[c] || (std::isnan(mapped) && std::isnan(expected[c]))));
  }
}

}  // namespace

TEST_CASE("lowered converter: stays within its proven bound of the interpreter, whatever the convention") {
  for (const Fit& fit : fits()) {
    INFO(kind_name(fit.mapping) << " of " << encoding_name(fit.source.roughness));
    const auto converter = make_lowered_converter(fit);
    TestTexels in = odd_and_random_texels(converter->info(), 2000);
    // Converters that use only floats do not change channels beyond 1e30.
    for (auto& row : in.specular)
      for (float& value : row)
        if (value > 1e30f && std::isfinite(value)) value = 1e3f;
    const Converted out = converted(*converter, in, 0, in.roughness.size(), 3, false);
    for (std::size_t i = 0; i < in.roughness.size(); ++i) check_texel(fit, in, out.rows, i);
    const Converted expected =
        converted(*make_interpreted_converter(fit), in, 0, in.roughness.size(), 3, false);
    CHECK(out.out_of_domain == expected.out_of_domain);
    CHECK(converter->self_test());
  }
}

TEST_CASE("lowered converter: every instruction set computes the same bits") {
  for (const Fit& fit : fits()) {
    INFO(kind_name(fit.mapping) << " of " << encoding_name(fit.source.roughness));
    const auto baseline = make_lowered_converter(fit, InstructionSet::kBaseline);
    const TestTexels texels = odd_and_random_texels(baseline->info(), 1000);
    for (const InstructionSet set : instruction_sets()) {
      INFO(instruction_set_name(set));
      const auto converter = make_lowered_converter(fit, set);
      CHECK(converter->info().instructions == set);
      CHECK(same_bits(*converter, *baseline, texels));
    }
  }
}
