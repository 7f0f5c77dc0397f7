// This file tests diagnoses of metallic materials, and the estimate of a dielectric's F0.
#include <limits>

#include <catch2/catch.hpp>

#include "reference/workflow_conversion.hpp"
#include "runtime/stages/materials.hpp"

using namespace remap;
using namespace workflow_test;

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
