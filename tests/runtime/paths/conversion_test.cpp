// This file tests how names of models become ends of a conversion (prefixes, and which end follows the
// other), and chains of converters against their steps one after another, and against the interpreter.
#include "remap/conversion.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "lower/interpreter.hpp"
#include "lower/lower.hpp"
#include "remap/error.hpp"
#include "remap/path.hpp"
#include "remap/shipped_converters.hpp"
#include "runtime/convert/texel_rows.hpp"
#include "stages/stage.hpp"
#include "support/error_of.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"

using namespace remap;

namespace {

ConversionChoice choice_of(const std::string& source, const std::string& target) {
  ConversionRequest request;
  request.source = model_named(source);
  request.target = model_named(target);
  return choose_conversion(request, shipped_graph());
}

// Returns the conventions of both ends, such as `plain scaled`, and `?` if they were assumed.
std::string diffuse_of_ends(const std::string& source, const std::string& target) {
  const ConversionChoice choice = choice_of(source, target);
  return std::string(diffuse_convention_name(diffuse_of(*choice.source))) + " " +
         std::string(diffuse_convention_name(diffuse_of(*choice.target))) +
         (choice.assumptions.empty() ? "" : " ?");
}

}  // namespace

TEST_CASE("conversion: an end without a convention follows the other, unless a prefix states one") {
  CHECK(diffuse_of_ends("gltf-specgloss", "gltf") == "scaled scaled");
  CHECK(diffuse_of_ends("plain:gltf-specgloss", "gltf") == "plain scaled");
  CHECK(diffuse_of_ends("gltf-specgloss", "plain:gltf") == "scaled plain");
  CHECK(diffuse_of_ends("gltf-specgloss", "metallic") == "scaled scaled ?");
  CHECK(diffuse_of_ends("gltf-specgloss", "plain:metallic") == "scaled plain");
  CHECK(diffuse_of_ends("plain:gltf-specgloss", "metallic") == "plain plain");
  CHECK(diffuse_of_ends("specular", "gltf") == "scaled scaled ?");
  CHECK(diffuse_of_ends("plain:specular", "gltf") == "plain scaled");
  CHECK(diffuse_of_ends("specular", "metallic") == "plain plain ?");
  CHECK(diffuse_of_ends("specular", "scaled:metallic") == "scaled scaled");
  CHECK(diffuse_of_ends("scaled:specular:mitsuba/ward", "specular:mitsuba/as") == "scaled scaled");
  CHECK(diffuse_of_ends("specular:scaled:mitsuba/ward", "metallic:plain:mitsuba/ggx") == "scaled plain");
}

TEST_CASE("conversion: an assumption names what to type instead") {
  const auto assumed = [](const std::string& source, const std::string& target) {
    return choice_of(source, target).assumptions.at(0);
  };
  CHECK_THAT(assumed("gltf-specgloss", "unreal"), Catch::EndsWith("use target plain:unreal)"));
  CHECK_THAT(assumed("specular:mitsuba/ward", "metallic:mitsuba/ggx"),
             Catch::EndsWith("use source scaled:specular:mitsuba/ward)"));
}

TEST_CASE("conversion: diffuse needs a workflow") {
  CHECK_THROWS_WITH(choice_of("plain:mitsuba/ward", "mitsuba/as"),
                    Catch::Contains("write plain:specular:mitsuba/ward"));
  CHECK_THROWS_AS(choice_of("mitsuba/ward", "scaled:mitsuba/as"), Error);
}

namespace {

using Steps = std::vector<const Converter*>;

// An InTurn runs each step over whole rows. A texel is out of domain if any step is.
class InTurn {
 public:
  explicit InTurn(Steps steps) : steps_(std::move(steps)) {}

  std::size_t convert(std::size_t count, const float* width, std::span<const float* const> specular,
                      float* width_out, std::span<float* const> specular_out) const {
    std::vector<bool> outside(count, false);
    std::vector<const float*> in(specular.begin(), specular.end());
    for (const Converter* step : steps_) {
      for (std::size_t i = 0; i < count; ++i)
        if (counts(*step, width[i], in, i)) outside[i] = true;
      step->convert(count, width, in, width_out, specular_out);
      width = width_out;
      in.assign(specular_out.begin(), specular_out.end());
    }
    return static_cast<std::size_t>(std::count(outside.begin(), outside.end(), true));
  }

 private:
  static bool counts(const Converter& step, float width, const std::vector<const float*>& rows,
                     std::size_t texel) {
    std::array<const float*, 3> in{};
    std::array<float, 3> values{};
    std::array<float*, 3> out{};
    for (std::size_t c = 0; c < rows.size(); ++c) {
      in[c] = rows[c] + texel;
      out[c] = &values[c];
    }
    float ignored = 0.0f;
    return step.convert(1, &width, {in.data(), rows.size()}, &ignored, {out.data(), rows.size()}) == 1;
  }

  Steps steps_;
};

// Returns a fit with alpha2 = slope * alpha and specular2 = factor * specular.
Fit proportional_fit(const std::string& source, const std::string& target, double slope, double factor) {
  Fit fit = example_fit();
  fit.id = converter_id(source, target);
  fit.source = {source, RoughnessEncoding::kAlpha, "specular"};
  fit.target = {target, RoughnessEncoding::kAlpha, "specular"};
  fit.mapping = Parametric{{{slope}}, {{1, {factor, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
  return fit;
}

// Returns three fits in sequence with three conventions. Each domain is narrower than the results of the
// previous fit.
std::vector<Fit> three_fits() {
  Fit first = example_fit(), second = example_fit(), third = example_fit();
  second.id = "example_b_to_example_c";
  second.source = first.target;
  second.target = {"example/c", RoughnessEncoding::kExponent, "specular"};
  second.domain = {{0.06, 0.55}, {0.0, 0.3}};
  second.mapping = Parametric{{{0.9, 0.1}, {0.05, -0.02}}, {{1, {1.1, -0.2, 0.7, 0.0, 0.0, 0.0}}}};
  third.id = "example_c_to_example_d";
  third.source = second.target;
  third.target = {"example/d", RoughnessEncoding::kGlossiness, "f0"};
  third.domain = {{0.08, 0.5}, {0.0, 0.25}};
  third.mapping = Parametric{{{1.2, -0.3}}, {{1, {0.7, 0.0, 0.0, 0.2, 1.0, 0.0}}}};
  return {first, second, third};
}

struct SteppedFits {
  std::vector<Fit> fits;
  std::vector<std::unique_ptr<Converter>> owned;
  Steps steps;

  explicit SteppedFits(std::vector<Fit> made, InstructionSet set = best_instruction_set())
      : fits(std::move(made)) {
    for (Fit& fit : fits) {
      add_converter(&fit);
      owned.push_back(make_lowered_converter(fit, set));
      steps.push_back(owned.back().get());
    }
  }
};

}  // namespace

TEST_CASE("chained converter: gives the bits of its steps one after another, and counts each texel once") {
  const SteppedFits chain(three_fits());
  for (std::size_t count = 1; count <= 3; ++count) {
    const Steps steps(chain.steps.begin(), chain.steps.begin() + static_cast<std::ptrdiff_t>(count));
    const auto chained = make_chained_converter(steps);
    CHECK(same_bits(*chained, InTurn(steps), odd_and_random_texels(steps.front()->info(), 3001)));
    CHECK(chained->self_test());
  }
}

TEST_CASE("chained converter: rows around the length of its blocks, grey and RGB") {
  const SteppedFits chain(three_fits());
  const auto chained = make_chained_converter(chain.steps);
  const InTurn in_turn(chain.steps);
  const TestTexels texels = odd_and_random_texels(chain.steps.front()->info(), 2000);
  for (const std::size_t count : {511u, 512u, 513u, 1023u, 1024u, 1025u, 2047u, 2049u})
    for (const std::size_t channels : {1u, 3u})
      for (const bool in_place : {false, true}) {
        INFO(count << " texels of " << channels << " channels");
        const Converted a = converted(*chained, texels, 100, count, channels, in_place);
        const Converted b = converted(in_turn, texels, 100, count, channels, false);
        CHECK(a.out_of_domain == b.out_of_domain);
        CHECK(same_bits(a.rows.roughness, b.rows.roughness));
        for (std::size_t c = 0; c < channels; ++c) CHECK(same_bits(a.rows.specular[c], b.rows.specular[c]));
      }
}

TEST_CASE("chained converter: every instruction set computes the same bits") {
  const SteppedFits baseline(three_fits(), InstructionSet::kBaseline);
  const auto expected = make_chained_converter(baseline.steps);
  const TestTexels texels = odd_and_random_texels(expected->info(), 1500);
  for (const InstructionSet set : instruction_sets()) {
    const SteppedFits chain(three_fits(), set);
    const auto chained = make_chained_converter(chain.steps);
    CHECK(chained->info().instructions == set);
    CHECK(same_bits(*chained, *expected, texels));
  }
}

TEST_CASE("chained converter: says what it is made of") {
  std::vector<Fit> fits = three_fits();
  for (Fit& fit : fits) {
    fit.alpha_error.rms = 0.001;
    fit.specular_error.rms = 0.002;
    fit.image_error = ErrorFigures{0.05, 0.06, 0.07};
    fit.ssim = {{0.1, 1.0}, {0.5, 0.9}};
  }
  fits[1].ssim = {{0.1, 0.8}, {0.5, 0.9}};
  const ConverterInfo info = make_chained_converter(SteppedFits(fits).steps)->info();
  CHECK(info.id == "example_a_to_example_d");
  CHECK(info.source == fits.front().source);
  CHECK(info.target == fits.back().target);
  CHECK(info.steps == std::vector<std::string>{fits[0].id, fits[1].id, fits[2].id});
  CHECK(info.roughness_rms_error.value() == Approx(0.003));
  CHECK(info.specular_rms_error.value() == Approx(0.006));
  CHECK(*info.image_rms_error == Approx(0.15));
  CHECK(info.ssim.value() == Approx(0.85));
  fits[1].image_error.reset();
  fits[1].ssim.clear();
  const ConverterInfo unknown = make_chained_converter(SteppedFits(fits).steps)->info();
  CHECK_FALSE(unknown.image_rms_error.has_value());
  CHECK_FALSE(unknown.ssim.has_value());
}

TEST_CASE("chained converter: its domain is the part of the first that every step covers") {
  Fit first = proportional_fit("r/a", "r/b", 0.8, 1.25), second = proportional_fit("r/b", "r/c", 1.0, 1.0);
  second.domain = {{0.1, 0.6}, {0.0, 0.25}};
  const ConverterInfo info = make_chained_converter(SteppedFits({first, second}).steps)->info();
  // Polynomials are exact to 1e-5, and the ends are rounded to 4 digits.
  CHECK(info.roughness.min == Approx(0.125).margin(2e-4));
  CHECK(info.roughness.max == Approx(0.75).margin(2e-4));
  CHECK(info.specular.min == 0.0);
  CHECK(info.specular.max == Approx(0.2).margin(2e-4));
  second.domain = {{0.01, 1.0}, {0.0, 1.0}};
  const ConverterInfo whole = make_chained_converter(SteppedFits({first, second}).steps)->info();
  const ConverterInfo own = make_lowered_converter(first)->info();
  CHECK(whole.roughness == own.roughness);
  CHECK(whole.specular == own.specular);
  second.domain = {{0.9, 1.0}, {0.0, 1.0}};  // no result of the first fit reaches this domain
  CHECK(make_chained_converter(SteppedFits({first, second}).steps)->info().roughness == own.roughness);
}

TEST_CASE("chained converter: a step that takes other parameters than the one before gives is refused") {
  Fit first = proportional_fit("r/a", "r/b", 0.8, 1.0), second = proportional_fit("r/b", "r/c", 1.0, 1.0);
  second.source.roughness = RoughnessEncoding::kRoughness;
  const SteppedFits chain({first, second});
  CHECK(
      error_of([&] { make_chained_converter(chain.steps); }, ErrorKind::kInput) ==
      "r_a_to_r_b then r_b_to_r_c: the first converts to alpha and specular of r/b, but the second converts "
      "from roughness and specular of r/b");
  CHECK_THROWS_AS(make_chained_converter({chain.steps[1], chain.steps[0]}), Error);
}
