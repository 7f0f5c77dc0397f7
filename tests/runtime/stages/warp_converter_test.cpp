// The pass of a compiled warp against the same warp in double precision, one texel at a time.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "remap/warp.hpp"
#include "stages/kernels.hpp"
#include "support/random_warp.hpp"
#include "support/warp_rows.hpp"

using namespace remap;

namespace {

bool is_within(float value) { return value >= 0.0f && value <= 1.0f; }

std::vector<InstructionSet> available_sets() {
  std::vector<InstructionSet> sets = {InstructionSet::kBaseline};
  for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512})
    if (set <= best_instruction_set()) sets.push_back(set);
  return sets;
}

}  // namespace

TEST_CASE("warp converter: every texel is that of the warp in double precision") {
  const auto dimension = GENERATE(as<std::size_t>{}, 1, 2, 3),
             count = GENERATE(as<std::size_t>{}, 1, 63, 64, 1000);
  const bool quadratic = GENERATE(false, true);
  const CompiledWarp warp = random_warp({dimension, quadratic, false}, 11);
  const PackedWarp pass = packed(warp);
  const WarpRows rows = random_rows(count);
  WarpRows found(count);
  const std::size_t outside =
      kernels(InstructionSet::kBaseline).warp(pass, count, rows.sources(), found.targets());
  std::size_t expected_outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const WarpTexel texel = rows.texel(i), expected = evaluate_warp(warp, texel);
    bool within = true;
    for (std::size_t r = 0; r < texel.size(); ++r) {
      REQUIRE(found.row[r][i] == Approx(expected[r]).margin(1e-4));
      within = within && is_within(texel[r]);
    }
    expected_outside += !within;
  }
  CHECK(outside == expected_outside);
}

TEST_CASE("warp converter: tables of copied nodes give texels of the palette, those of the nearest node") {
  constexpr std::size_t kCount = 1000;
  const auto dimension = GENERATE(as<std::size_t>{}, 1, 2, 3);
  const bool quadratic = GENERATE(false, true);
  const CompiledWarp warp = random_warp({dimension, quadratic, true}, 13);
  const auto& palette = std::get<CopiedNodes>(warp.table.entries).palette;
  const WarpRows rows = random_rows(kCount);
  WarpRows found(kCount);
  kernels(InstructionSet::kBaseline).warp(packed(warp), kCount, rows.sources(), found.targets());
  std::size_t others = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const WarpTexel result = found.texel(i);
    REQUIRE(std::find(palette.begin(), palette.end(), result) != palette.end());
    others += result != evaluate_warp(warp, rows.texel(i));
    if (result == evaluate_warp(warp, rows.texel(i))) continue;
    // Only where the pass in floats and the oracle may round to two sides.
    double to_tie = 1.0;
    for (const double place : node_position_of(warp, rows.texel(i)))
      to_tie = std::min(to_tie, std::fabs(place - std::floor(place) - 0.5));
    REQUIRE(to_tie < 1e-4);
  }
  CHECK(others < 5);
}

TEST_CASE("warp converter: quadratic coordinates hold at black and at the least numbers") {
  const CompiledWarp warp = random_warp({3, true, false}, 21);
  const PackedWarp pass = packed(warp);
  for (const float value : {0.0f, -0.0f, 1e-45f, 1e-40f, 1.2e-38f, 1e-30f, 1e-12f, 1e-6f, 1e-3f, 1.0f}) {
    WarpRows rows(1), found(1);
    for (auto& row : rows.row) row[0] = value;
    kernels(InstructionSet::kBaseline).warp(pass, 1, rows.sources(), found.targets());
    const WarpTexel expected = evaluate_warp(warp, rows.texel(0));
    for (std::size_t p = 0; p < kWarpParameters; ++p)
      CHECK(found.row[p][0] == Approx(expected[p]).margin(1e-4));
  }
}

TEST_CASE("warp converter: every instruction set gives the same bits, in place too") {
  constexpr std::size_t kCount = 517;
  const auto dimension = GENERATE(as<std::size_t>{}, 1, 2, 3);
  const bool quadratic = GENERATE(false, true), copied = GENERATE(false, true);
  const PackedWarp pass = packed(random_warp({dimension, quadratic, copied}, 5, 17));
  WarpRows expected(kCount);
  const WarpRows rows = random_rows(kCount);
  kernels(InstructionSet::kBaseline).warp(pass, kCount, rows.sources(), expected.targets());
  for (const InstructionSet set : available_sets()) {
    WarpRows found = rows, single = rows;
    kernels(set).warp(pass, kCount, found.sources(), found.targets());
    for (std::size_t i = 0; i < kCount; ++i) {
      auto from = single.sources();
      auto to = single.targets();
      for (std::size_t r = 0; r < from.size(); ++r) {
        from[r] += i;
        to[r] += i;
      }
      kernels(set).warp(pass, 1, from, to);
    }
    for (std::size_t r = 0; r < found.row.size(); ++r) {
      REQUIRE(std::memcmp(found.row[r].data(), expected.row[r].data(), kCount * sizeof(float)) == 0);
      REQUIRE(std::memcmp(single.row[r].data(), expected.row[r].data(), kCount * sizeof(float)) == 0);
    }
  }
}

TEST_CASE("warp converter: NaN stays NaN, infinity and negative values are clamped") {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(),
                  kNan = std::numeric_limits<float>::quiet_NaN();
  const bool quadratic = GENERATE(false, true);
  const CompiledWarp warp = random_warp({3, quadratic, false}, 2);
  const PackedWarp pass = packed(warp);
  for (const InstructionSet set : available_sets())
    for (const float odd : {kNan, -kNan, kInfinity, -kInfinity, -1e30f, 0.0f, -0.0f, 1e-40f})
      for (std::size_t r = 0; r < kWarpParameters; ++r) {
        WarpRows rows = random_rows(70), found(70);
        rows.row[r][66] = odd;
        kernels(set).warp(pass, 70, rows.sources(), found.targets());
        const WarpTexel expected = evaluate_warp(warp, rows.texel(66));
        for (std::size_t p = 0; p < kWarpParameters; ++p) {
          CAPTURE(odd, r, p);
          if (std::isnan(odd))
            REQUIRE(std::isnan(found.row[p][66]));
          else
            REQUIRE(found.row[p][66] == Approx(expected[p]).margin(1e-4));
          REQUIRE(std::isfinite(found.row[p][65]));
        }
      }
}

TEST_CASE("warp converter: materials go by parameter, grey specular stands for three channels") {
  WarpMapFit fit;
  fit.id = "stone";
  fit.source_model = fit.template_model = "mitsuba/ggx";
  fit.warp = random_warp(2, 8);
  const auto converter = make_warp_converter(fit, SpecularWorkflow{}, InstructionSet::kBaseline);
  REQUIRE(converter->sources().size() == 3);
  CHECK(converter->target_channels(Parameter::kSpecular, 1) == 3);
  const std::array<float, 3> diffuse = {0.2f, 0.3f, 0.4f};
  const float specular = 0.04f, alpha = 0.3f;
  std::array<float, 7> result{};
  MaterialRows<const float> in;
  MaterialRows<float> out;
  in[Parameter::kDiffuse] = {{&diffuse[0], &diffuse[1], &diffuse[2]}, 3};
  in[Parameter::kSpecular] = {{&specular}, 1};
  in[Parameter::kRoughness] = {{&alpha}, 1};
  out[Parameter::kDiffuse] = {{&result[0], &result[1], &result[2]}, 3};
  out[Parameter::kSpecular] = {{&result[3], &result[4], &result[5]}, 3};
  out[Parameter::kRoughness] = {{&result[6]}, 1};
  CHECK(converter->convert(1, in, out) == 0);
  const WarpTexel expected =
      evaluate_warp(fit.warp, {diffuse[0], diffuse[1], diffuse[2], specular, specular, specular, alpha});
  for (std::size_t p = 0; p < expected.size(); ++p) CHECK(result[p] == Approx(expected[p]).margin(1e-4));
}

TEST_CASE("warp converter: a metallic source goes by equation (2) first") {
  constexpr std::size_t kCount = 1500;
  WarpMapFit fit;
  fit.id = "stone";
  fit.source_model = fit.template_model = "mitsuba/ggx";
  fit.warp = random_warp(2, 8);
  const auto converter = make_warp_converter(fit, MetallicWorkflow{});
  CHECK(converter->sources() ==
        std::vector<Parameter>{Parameter::kRoughness, Parameter::kBaseColor, Parameter::kMetallic});
  WarpRows rows(kCount), found(kCount);
  std::mt19937 engine(4);
  for (auto& row : rows.row)
    for (float& value : row) value = static_cast<float>(engine() >> 8) * 0x1p-24f;
  MaterialRows<const float> in;
  MaterialRows<float> out;
  in[Parameter::kBaseColor] = {{rows.row[0].data(), rows.row[1].data(), rows.row[2].data()}, 3};
  in[Parameter::kMetallic] = {{rows.row[3].data()}, 1};
  in[Parameter::kRoughness] = {{rows.row[4].data()}, 1};
  const auto to = found.targets();
  out[Parameter::kDiffuse] = {{to[0], to[1], to[2]}, 3};
  out[Parameter::kSpecular] = {{to[3], to[4], to[5]}, 3};
  out[Parameter::kRoughness] = {{to[6]}, 1};
  CHECK(converter->convert(kCount, in, out) == 0);
  for (std::size_t i = 0; i < kCount; ++i) {
    const float metallic = rows.row[3][i];
    WarpTexel texel{};
    for (std::size_t c = 0; c < 3; ++c) {
      texel[c] = rows.row[c][i] * (1.0f - metallic);
      texel[3 + c] = 0.04f * (1.0f - metallic) + rows.row[c][i] * metallic;
    }
    texel[6] = rows.row[4][i];
    const WarpTexel expected = evaluate_warp(fit.warp, texel);
    for (std::size_t p = 0; p < kWarpParameters; ++p)
      REQUIRE(found.row[p][i] == Approx(expected[p]).margin(2e-4));
  }
}
