// This file tests equation (2) by pictures: a metallic material and the specular material that it converts to
// look the same (figure 20 of Sztrajman et al. 2019).
#include <cmath>

#include <catch2/catch.hpp>

#include "reference/workflow_conversion.hpp"
#include "renderer/renderer.hpp"

using namespace remap;

namespace {

std::vector<double> rgb(const std::array<float, 3>& color) { return {color[0], color[1], color[2]}; }

double largest_difference(const Image& a, const Image& b) {
  REQUIRE(a.values.size() == b.values.size());
  double difference = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    difference = std::max(difference, std::fabs(static_cast<double>(a.values[i]) - b.values[i]));
    peak = std::max(peak, static_cast<double>(b.values[i]));
  }
  return difference / peak;
}

}  // namespace

TEST_CASE("equation (2): the pictures of both materials are the same to 1e-6") {
  const auto renderer = make_builtin_renderer();
  Scene scene;
  scene.resolution = 64;
  scene.light.angle = 45.0;
  for (const double f0 : {0.03, 0.04}) {
    WorkflowConversion conversion;
    conversion.metallic.dielectric_f0 = f0;
    conversion.specular.width = RoughnessEncoding::kAlpha;
    conversion.formula = ClosedFormula::kEquation2;
    for (const float metallic : {0.0f, 0.3f, 0.7f, 1.0f})
      for (const float roughness : {0.4f, 0.7f}) {
        const MetallicMaterial material{{0.9f, 0.5f, 0.1f}, metallic, roughness};
        const SpecularMaterial specular = to_specular(conversion, material);
        const Image expected = renderer->render({"mitsuba/ggx-metallic",
                                                 {{"base_color", rgb(material.base_color)},
                                                  {"metallic", {metallic}},
                                                  {"specular", {f0 / 0.08}},
                                                  {"roughness", {roughness}}}},
                                                scene);
        const Image converted = renderer->render({"mitsuba/ggx",
                                                  {{"alpha", {specular.width}},
                                                   {"f0", rgb(specular.specular)},
                                                   {"diffuse", rgb(specular.diffuse)}}},
                                                 scene);
        CHECK(largest_difference(converted, expected) < 1e-6);
      }
  }
}
