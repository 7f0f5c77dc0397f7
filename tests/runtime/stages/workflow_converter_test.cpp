// This file tests how a texture pass converts whole materials between workflows. texremap_workflow_test
// compares specular to metallic with the reference, bit for bit.
#include <array>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "stages/stage.hpp"

using namespace remap;

namespace {

constexpr std::size_t kTexels = 700;  // more than a block

}  // namespace

TEST_CASE("workflow converter: a grey diffuse row becomes three, of which it is the first") {
  constexpr std::size_t kCount = 1500;  // more than a block
  WorkflowStages stages;
  SpecularWorkflow scaled;
  scaled.diffuse = DiffuseConvention::kScaled;
  stages.source = scaled;
  stages.target = SpecularWorkflow{};
  const auto converter = make_workflow_converter(stages);
  std::vector<float> width(kCount, 0.5f), specular(kCount), grey(kCount), green(kCount), blue(kCount);
  std::vector<std::vector<float>> specular_out(3, std::vector<float>(kCount));
  for (std::size_t i = 0; i < kCount; ++i) {
    specular[i] = static_cast<float>(i) / kCount;
    grey[i] = static_cast<float>(i % 7) / 7.0f;
  }
  const std::vector<float> given = grey;
  MaterialRows<const float> in;
  in[Parameter::kRoughness] = {{width.data()}, 1};
  in[Parameter::kSpecular] = {{specular.data()}, 1};
  in[Parameter::kDiffuse] = {{grey.data()}, 1};
  MaterialRows<float> out;
  out[Parameter::kRoughness] = {{width.data()}, 1};
  out[Parameter::kSpecular] = {{specular_out[0].data(), specular_out[1].data(), specular_out[2].data()}, 3};
  out[Parameter::kDiffuse] = {{grey.data(), green.data(), blue.data()}, 3};
  CHECK(converter->convert(kCount, in, out) == 0);
  for (std::size_t i = 0; i < kCount; ++i) {
    const float expected = given[i] * (1.0f - specular[i]);
    CAPTURE(i);
    REQUIRE(grey[i] == expected);
    REQUIRE(green[i] == expected);
    REQUIRE(blue[i] == expected);
    for (const auto& row : specular_out) REQUIRE(row[i] == specular[i]);
  }
}

TEST_CASE(
    "workflow converter: dielectrics of an F0 for each texel are those of one F0 where it is everywhere") {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<std::vector<float>> in_rows(8, std::vector<float>(kTexels)), expected(7, in_rows[0]),
      found(7, in_rows[0]);
  for (const double f0 : {0.0, kCommonDielectricF0, 0.3, 0.9}) {
    for (std::size_t i = 0; i < kTexels; ++i) {
      for (std::size_t r = 0; r < 5; ++r) in_rows[r][i] = unit(random);
      for (std::size_t r = 5; r < 8; ++r) in_rows[r][i] = static_cast<float>(f0);
    }
    MaterialRows<const float> in;
    in[Parameter::kBaseColor] = {{in_rows[0].data(), in_rows[1].data(), in_rows[2].data()}, 3};
    in[Parameter::kMetallic] = {{in_rows[3].data()}, 1};
    in[Parameter::kRoughness] = {{in_rows[4].data()}, 1};
    const auto convert = [&](const Converter& converter, std::vector<std::vector<float>>& rows) {
      MaterialRows<float> out;
      out[Parameter::kDiffuse] = {{rows[0].data(), rows[1].data(), rows[2].data()}, 3};
      out[Parameter::kSpecular] = {{rows[3].data(), rows[4].data(), rows[5].data()}, 3};
      out[Parameter::kRoughness] = {{rows[6].data()}, 1};
      converter.convert(kTexels, in, out);
    };
    WorkflowStages stages;
    stages.source = MetallicWorkflow{"metallic", f0, DiffuseConvention::kScaled};
    stages.target = SpecularWorkflow{};
    convert(*make_workflow_converter(stages, InstructionSet::kBaseline), expected);
    in[Parameter::kSpecular] = {{in_rows[5].data(), in_rows[6].data(), in_rows[7].data()}, 3};
    convert(*make_dielectric_converter(stages, InstructionSet::kBaseline), found);
    double largest = 0.0;
    for (std::size_t r = 0; r < found.size(); ++r)
      for (std::size_t i = 0; i < kTexels; ++i)
        largest = std::max(largest, std::fabs(static_cast<double>(expected[r][i] - found[r][i])));
    CAPTURE(f0);
    CHECK(largest < 1e-6);  // the order of float operations differs
  }
}
