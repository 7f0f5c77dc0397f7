// This file tests workflow conversions against values computed by hand, published formulas, and an oracle
// that searches everywhere. It also tests diagnoses of metallic materials, and the estimate of a
// dielectric's F0.
#include "reference/workflow_conversion.hpp"

#include <cstring>
#include <limits>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "runtime/stages/materials.hpp"

using namespace remap;
using namespace workflow_test;

namespace {

double squared(double value) { return value * value; }

struct FamilyError {
  double metallic, base_color;  // root mean squares, for base color in sRGB
};

// Converts random metallic materials to specular and back. `stored` rounds them in between.
template <typename Stored>
FamilyError family_error(const WorkflowConversion& back, const WorkflowConversion& there, int count,
                         const Stored& stored) {
  std::mt19937 random(11);
  double metallic = 0.0, color = 0.0;
  for (int i = 0; i < count; ++i) {
    const MetallicMaterial truth = random_metallic(random);
    SpecularMaterial material = to_specular(there, truth);
    for (std::size_t c = 0; c < 3; ++c) {
      material.diffuse[c] = static_cast<float>(stored(material.diffuse[c]));
      material.specular[c] = static_cast<float>(stored(material.specular[c]));
    }
    const MetallicMaterial result = to_metallic(back, material);
    metallic += squared(result.metallic - truth.metallic);
    for (std::size_t c = 0; c < 3; ++c)
      color += squared(linear_to_srgb(result.base_color[c]) - linear_to_srgb(truth.base_color[c])) / 3.0;
  }
  return {std::sqrt(metallic / count), std::sqrt(color / count)};
}

double as_it_is(double value) { return value; }

}  // namespace

TEST_CASE("equation (2): by hand, plain and scaled diffuse") {
  const MetallicMaterial material{{0.5f, 0.2f, 0.0f}, 0.25f, 0.3f};
  const SpecularMaterial result = to_specular(plain(ClosedFormula::kEquation2), material);
  CHECK(result.diffuse[0] == Approx(0.375));
  CHECK(result.diffuse[1] == Approx(0.15));
  CHECK(result.diffuse[2] == 0.0f);
  CHECK(result.specular[0] == Approx(0.155));  // 0.03 + 0.125
  CHECK(result.specular[1] == Approx(0.08));
  CHECK(result.specular[2] == Approx(0.03));
  CHECK(result.width == 0.3f);
  const SpecularMaterial scaled = to_specular(gltf(ClosedFormula::kEquation2), material);
  CHECK(scaled.diffuse[0] == Approx(0.96 * 0.375 / (1.0 - 0.155)));
  CHECK(scaled.specular[0] == Approx(0.155));
  CHECK(scaled.width == Approx(0.7));  // glossiness
  CHECK(to_specular(plain(ClosedFormula::kEquation2, 0.03), material).specular[2] == Approx(0.0225));
}

TEST_CASE("equation (3): by hand, both means, and a channel that says nothing of metallic") {
  const SpecularMaterial material{{0.2f, 0.4f, 0.1f}, {0.1f, 0.05f, 0.3f}, 0.5f};
  const MetallicMaterial mean = to_metallic(plain(ClosedFormula::kEquation3, 0.03), material);
  CHECK(mean.base_color[0] == Approx(0.278452).epsilon(1e-5));
  CHECK(mean.base_color[1] == Approx(0.421532).epsilon(1e-5));
  CHECK(mean.base_color[2] == Approx(0.392354).epsilon(1e-5));
  CHECK(mean.metallic == Approx(0.359318).epsilon(1e-5));
  CHECK(to_metallic(plain(ClosedFormula::kEquation3ByAlbedo, 0.03), material).metallic ==
        Approx(0.359173).epsilon(1e-5));
  const SpecularMaterial flat{{0.0f, 0.375f, 0.375f}, {0.04f, 0.155f, 0.155f}, 0.5f};
  CHECK(to_metallic(plain(ClosedFormula::kEquation3), flat).metallic == Approx(0.5 / 3.0));
}

TEST_CASE("Khronos' solver: the published formula by hand") {
  const SpecularMaterial material{{0.5f, 0.3f, 0.2f}, {0.2f, 0.3f, 0.1f}, 0.75f};
  const MetallicMaterial result = to_metallic(gltf(ClosedFormula::kKhronos), material);
  CHECK(result.metallic == Approx(0.470570).epsilon(1e-5));
  CHECK(result.base_color[0] == Approx(0.620294).epsilon(1e-4));
  CHECK(result.base_color[1] == Approx(0.452893).epsilon(1e-4));
  CHECK(result.base_color[2] == Approx(0.251550).epsilon(1e-4));
  CHECK(result.width == 0.25f);
  CHECK(to_metallic(gltf(ClosedFormula::kKhronos), {{0.5f, 0.5f, 0.5f}, {0.02f, 0.02f, 0.02f}, 0.5f})
            .metallic == 0.0f);
}

TEST_CASE("projection: as good as looking everywhere, off the family too", "[slow]") {
  std::mt19937 random(5);
  for (const bool scaled : {false, true}) {
    const WorkflowConversion conversion = scaled ? gltf(Projection{0.0}) : plain(Projection{0.0});
    double excess = 0.0, floor = 0.0, worst = 0.0;
    constexpr int kCount = 400;
    for (int i = 0; i < kCount; ++i) {
      const SpecularMaterial material = random_reflecting(random, !scaled);
      const double roughness = scaled ? 1.0 - material.width : material.width;
      const Oracle oracle(material, roughness * roughness, 0.04, scaled);
      const MetallicMaterial result = to_metallic(conversion, material);
      const double error =
          oracle.error(result.metallic, {result.base_color[0], result.base_color[1], result.base_color[2]});
      const double least = oracle.least_error(500);
      // The square root of the error is visible. Display values differ by 0.42 times this value.
      const double more = std::sqrt(std::max(error, 0.0)) - std::sqrt(least);
      excess += squared(std::max(more, 0.0));
      floor += least;
      worst = std::max(worst, more);
    }
    CHECK(std::sqrt(excess / kCount) < 0.025 * std::sqrt(floor / kCount));
    CHECK(worst < 0.05);
  }
}

TEST_CASE("projection: exact on the family, and to a quarter of a step of 8-bit maps") {
  constexpr int kCount = 100000;
  const FamilyError exact =
      family_error(plain(Projection{0.0}), plain(ClosedFormula::kEquation2), 20000, as_it_is);
  // In 8 bits, some values of F0 equal the F0 of a dielectric and are treated like it. This causes most of
  // the error.
  CHECK(exact.metallic < 5e-5);
  CHECK(exact.base_color < 2e-5);
  const FamilyError stored = family_error(plain(kClean), plain(ClosedFormula::kEquation2), kCount, in_8_bits);
  CHECK(stored.metallic <= 0.002);
  CHECK(stored.base_color <= 0.0015);
  const FamilyError scaled = family_error(gltf(kClean), gltf(ClosedFormula::kEquation2), kCount, in_8_bits);
  CHECK(scaled.metallic <= 0.002);
  // to get its base color, a metal's diffuse is divided by the little light that specular does not reflect
  CHECK(scaled.base_color <= 0.005);
}

// The same rivals were measured elsewhere with another set of random materials. Each agrees within 5 % in its
// own convention.
TEST_CASE("rivals on the family: as far off as they were measured") {
  const FamilyError mean =
      family_error(plain(ClosedFormula::kEquation3), plain(ClosedFormula::kEquation2), 100000, as_it_is);
  CHECK(mean.metallic == Approx(0.035).epsilon(0.1));
  const FamilyError weighted = family_error(plain(ClosedFormula::kEquation3ByAlbedo),
                                            plain(ClosedFormula::kEquation2), 100000, as_it_is);
  CHECK(weighted.metallic == Approx(0.006).epsilon(0.15));
  const FamilyError khronos =
      family_error(gltf(ClosedFormula::kKhronos), gltf(ClosedFormula::kEquation2), 100000, as_it_is);
  // A few dark dielectrics in a thousand become metal and dominate this figure, so it depends on the random
  // numbers.
  CHECK(khronos.metallic > 0.007);
  CHECK(khronos.metallic < 0.014);
}

TEST_CASE("every formula: black, white, specular below F0 and above 1 give a material") {
  const float big = std::numeric_limits<float>::infinity();
  const SpecularMaterial odd[] = {{{0, 0, 0}, {0, 0, 0}, 0},
                                  {{1, 1, 1}, {1, 1, 1}, 1},
                                  {{0, 0, 0}, {1, 1, 1}, 0.5f},
                                  {{1, 1, 1}, {0, 0, 0}, 0.5f},
                                  {{0.5f, 0.5f, 0.5f}, {0.02f, 0.02f, 0.02f}, 0.5f},
                                  {{0.01f, 0.01f, 0.01f}, {0.0395f, 0.0395f, 0.0395f}, 0.3f},
                                  {{0.2f, 0.2f, 0.2f}, {1.5f, 3.0f, 40.0f}, 0.5f},
                                  {{-1, -1, -1}, {-1, 0.5f, 2}, -3},
                                  {{big, 0, 0}, {0, big, 0}, big},
                                  {{-big, 1e-40f, 1e-30f}, {1e-40f, -0.0f, 1e-20f}, 1e-40f}};
  for (const WorkflowConversion& conversion :
       {plain(kClean), plain(kClean, 0.0), gltf(kClean), plain(ClosedFormula::kEquation3),
        gltf(ClosedFormula::kEquation3ByAlbedo), gltf(ClosedFormula::kKhronos)}) {
    INFO(formula_name(conversion.formula));
    for (const SpecularMaterial& material : odd) {
      const MetallicMaterial result = to_metallic(conversion, material);
      for (const float value : {result.base_color[0], result.base_color[1], result.base_color[2],
                                result.metallic, result.width}) {
        CHECK(value >= 0.0f);
        CHECK(value <= 1.0f);
      }
    }
  }
  CHECK(to_metallic(plain(kClean), odd[2]).metallic == 1.0f);
  CHECK(to_metallic(plain(kClean), odd[2]).base_color[1] == 1.0f);
  CHECK(to_metallic(plain(kClean), odd[3]).metallic == 0.0f);
  CHECK(to_metallic(plain(kClean), odd[3]).base_color[1] == Approx(1.0).margin(0.05));
  CHECK(to_metallic(plain(kClean), odd[4]).metallic == Approx(0.0).margin(0.01));
  // 8 bits store 0.04 as 0.0395. A dark dielectric must stay a dielectric.
  CHECK(to_metallic(plain(kClean), odd[5]).metallic < 0.05f);
}

TEST_CASE("NaN: in the outputs that depend on it, and nowhere else") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto is_nan = [](float value) { return std::isnan(value); };
  const SpecularMaterial good{{0.4f, 0.3f, 0.2f}, {0.1f, 0.1f, 0.1f}, 0.5f};
  for (const WorkflowConversion& conversion :
       {plain(kClean), plain(ClosedFormula::kEquation3ByAlbedo), gltf(ClosedFormula::kKhronos)}) {
    SpecularMaterial channel = good, width = good;
    channel.specular[1] = nan;
    width.width = -nan;
    const MetallicMaterial of_channel = to_metallic(conversion, channel);
    CHECK(is_nan(of_channel.metallic));
    CHECK(is_nan(of_channel.base_color[0]));
    CHECK(!is_nan(of_channel.width));
    CHECK(is_nan(to_metallic(conversion, width).width));
  }
  for (const WorkflowConversion& conversion :
       {plain(ClosedFormula::kEquation2), gltf(ClosedFormula::kEquation2)}) {
    const bool scaled = conversion.specular.diffuse == DiffuseConvention::kScaled;
    const SpecularMaterial result = to_specular(conversion, {{nan, 0.3f, 0.2f}, 0.5f, 0.5f});
    CHECK(is_nan(result.diffuse[0]));
    CHECK(is_nan(result.specular[0]));
    CHECK(!is_nan(result.specular[1]));
    CHECK(is_nan(result.diffuse[1]) == scaled);  // 1 - max(specular) is unknown
    CHECK(!is_nan(result.width));
    CHECK(is_nan(to_specular(conversion, {{0.1f, 0.3f, 0.2f}, nan, 0.5f}).specular[2]));
  }
}

TEST_CASE("rows: any count gives the bits of single texels, in place too, and counts what is beyond 0 to 1") {
  std::mt19937 random(3);
  for (const WorkflowConversion& conversion :
       {plain(kClean), gltf(kClean), gltf(ClosedFormula::kKhronos), plain(ClosedFormula::kEquation3ByAlbedo)})
    for (const std::size_t count : {1u, 15u, 16u, 17u, 129u}) {
      std::array<std::vector<float>, 7> rows;
      for (auto& row : rows) row.resize(count);
      std::vector<MetallicMaterial> expected;
      for (std::size_t i = 0; i < count; ++i) {
        SpecularMaterial material = random_specular(random);
        if (i % 5 == 2) material.specular[0] += 1.0f;
        for (std::size_t c = 0; c < 3; ++c) {
          rows[c][i] = material.diffuse[c];
          rows[3 + c][i] = material.specular[c];
        }
        rows[6][i] = material.width;
        expected.push_back(to_metallic(conversion, material));
      }
      std::array<const float*, 7> in{};
      std::array<float*, 5> out{};
      for (std::size_t r = 0; r < 7; ++r) in[r] = rows[r].data();
      for (std::size_t r = 0; r < 5; ++r) out[r] = rows[6 - r].data();
      CHECK(convert_workflow(conversion, count, in, out) == (count + 2) / 5);
      for (std::size_t i = 0; i < count; ++i) {
        const MetallicMaterial& e = expected[i];
        const float values[] = {e.base_color[0], e.base_color[1], e.base_color[2], e.metallic, e.width};
        for (std::size_t r = 0; r < 5; ++r) REQUIRE(std::memcmp(&out[r][i], &values[r], sizeof(float)) == 0);
      }
    }
}

TEST_CASE("widths: every pair of parameters leads through alpha") {
  for (const RoughnessEncoding from :
       {RoughnessEncoding::kAlpha, RoughnessEncoding::kRoughness, RoughnessEncoding::kGlossiness})
    for (const RoughnessEncoding to :
         {RoughnessEncoding::kAlpha, RoughnessEncoding::kRoughness, RoughnessEncoding::kGlossiness}) {
      WorkflowConversion conversion = plain(kClean);
      conversion.specular.width = from;
      conversion.metallic.width = to;
      const float own = 0.3f;
      const MetallicMaterial result = to_metallic(conversion, {{0.5f, 0.5f, 0.5f}, {0.1f, 0.1f, 0.1f}, own});
      CHECK(result.width == Approx(from_alpha(to, to_alpha(from, own))));
    }
}

TEST_CASE("conversions that make no sense are refused") {
  const auto refuses = [](const WorkflowConversion& conversion, const std::string& message) {
    CHECK_THROWS_WITH(require_valid(conversion, "x"), Catch::Contains(message));
  };
  refuses(plain(kClean, 1.2), "out of range (0 to 0.9");
  refuses(plain(Projection{-1.0}), "prior -1 is out of range");
  refuses(plain(ClosedFormula::kKhronos), "scaled diffuse on both sides");
  WorkflowConversion exponent = plain(kClean);
  exponent.specular.width = RoughnessEncoding::kExponent;
  refuses(exponent, "choose roughness, glossiness or alpha");
  CHECK_THROWS_WITH(to_specular(plain(kClean), {}), Catch::Contains("not the other way"));
  CHECK_THROWS_WITH(convert_workflow(plain(kClean), 0, {}, {}), Catch::Contains("(give 7)"));
}

namespace {

MetallicDiagnosis diagnosis_of(const WorkflowConversion& conversion, const SpecularMaterial& material) {
  return diagnose(conversion, material, to_metallic(conversion, material));
}

// Returns texels of metallic materials, as 8-bit maps store them.
std::vector<SpecularMaterial> stored_family(const WorkflowConversion& there, int count,
                                            float least_metallic) {
  std::mt19937 random(21);
  std::vector<SpecularMaterial> materials;
  for (int i = 0; i < count; ++i) {
    MetallicMaterial truth = random_metallic(random);
    truth.metallic = std::max(truth.metallic, least_metallic);
    SpecularMaterial material = to_specular(there, truth);
    for (std::size_t c = 0; c < 3; ++c) {
      material.diffuse[c] = static_cast<float>(in_8_bits(material.diffuse[c]));
      material.specular[c] = static_cast<float>(in_8_bits(material.specular[c]));
    }
    materials.push_back(material);
  }
  return materials;
}

DielectricF0 estimated_f0(const WorkflowConversion& conversion, std::span<const SpecularMaterial> materials) {
  return estimate_dielectric_f0(conversion.specular, conversion.metallic, materials);
}

}  // namespace

TEST_CASE("diagnosis: the residual is the root of the oracle's error, 0 on the family") {
  std::mt19937 random(8);
  for (int i = 0; i < 200; ++i) {
    const SpecularMaterial material = random_specular(random);
    const MetallicMaterial result = to_metallic(plain(kClean), material);
    const double alpha = static_cast<double>(material.width) * material.width;
    const double error =
        Oracle(material, alpha, 0.04, false)
            .error(result.metallic, {result.base_color[0], result.base_color[1], result.base_color[2]});
    CHECK(diagnose(plain(kClean), material, result).residual == Approx(std::sqrt(error)).margin(2e-3));
    const SpecularMaterial said = to_specular(plain(ClosedFormula::kEquation2), random_metallic(random));
    CHECK(diagnosis_of(plain(Projection{0.0}), said).residual < 2e-3);
  }
}

TEST_CASE("diagnosis: metallic is sharp where the picture depends on it and wide where it does not") {
  const SpecularMaterial gold =
      to_specular(plain(ClosedFormula::kEquation2), {{1.0f, 0.77f, 0.34f}, 1.0f, 0.3f});
  CHECK(diagnosis_of(plain(kClean), gold).metallic_uncertainty < 0.1f);
  // At an albedo close to F0, every metallic has the same F0 and hardly any diffuse.
  const SpecularMaterial soot =
      to_specular(plain(ClosedFormula::kEquation2), {{0.01f, 0.01f, 0.01f}, 0.0f, 0.9f});
  CHECK(diagnosis_of(plain(kClean), soot).metallic_uncertainty > 0.1f);
  const SpecularMaterial black{{0, 0, 0}, {0, 0, 0}, 0.5f};
  CHECK(diagnosis_of(plain(kClean), black).residual < 1e-3f);
}

TEST_CASE("diagnosis: clamped where a base color or a parameter was clamped") {
  // reflects twice the light that arrives
  const SpecularMaterial bright{{1.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 1.0f}, 0.5f};
  CHECK(diagnosis_of(plain(kClean), bright).is_clamped);
  CHECK(diagnosis_of(plain(kClean), {{0.5f, 0.5f, 0.5f}, {0.04f, 0.04f, 1.5f}, 0.5f}).is_clamped);
  CHECK(!diagnosis_of(plain(kClean), {{0.5f, 0.5f, 0.5f}, {0.04f, 0.04f, 0.04f}, 0.5f}).is_clamped);
  const SpecularMaterial white =
      to_specular(plain(ClosedFormula::kEquation2), {{1.0f, 1.0f, 1.0f}, 0.5f, 0.5f});
  CHECK(!diagnosis_of(plain(kClean), white).is_clamped);
  SpecularMaterial broken = white;
  broken.diffuse[0] = std::numeric_limits<float>::quiet_NaN();
  const MetallicDiagnosis nothing = diagnosis_of(plain(kClean), broken);
  CHECK(std::isnan(nothing.residual));
  CHECK(std::isnan(nothing.metallic_uncertainty));
  CHECK(nothing.is_clamped);
}

TEST_CASE("F0 of a dielectric: found in 8-bit maps, and said to be uncertain in maps of metal alone") {
  for (const double f0 : {0.02, 0.03, 0.04, 0.05}) {
    const auto materials = stored_family(plain(ClosedFormula::kEquation2, f0), 2000, 0.0f);
    const DielectricF0 found = estimated_f0(plain(kClean), materials);
    CHECK(found.f0 == Approx(f0).margin(1e-3));
    CHECK(found.is_certain);
    CHECK(found.residual < 0.01);
  }
  CHECK(!estimated_f0(plain(kClean), stored_family(plain(ClosedFormula::kEquation2), 500, 1.0f)).is_certain);
  const auto scaled = stored_family(gltf(ClosedFormula::kEquation2), 2000, 0.0f);
  CHECK(estimated_f0(gltf(kClean), scaled).f0 == Approx(0.04).margin(1e-3));
  CHECK_THROWS_WITH(estimated_f0(plain(kClean), {}), Catch::Contains("without a valid texel"));
}
