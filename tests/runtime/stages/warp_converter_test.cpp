// This file compares the pass of a compiled warp with the same warp in double precision, one texel at a time.
#include <algorithm>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "remap/warp.hpp"
#include "stages/kernels.hpp"
#include "support/random_warp.hpp"
#include "support/warp_rows.hpp"

using namespace remap;

TEST_CASE("warp converter: every texel equals the result of the warp in double precision") {
  const auto dimension = GENERATE(as<std::size_t>{}, 1, 2, 3),
             count = GENERATE(as<std::size_t>{}, 1, 63, 1000);
  const bool quadratic = GENERATE(false, true), copied = GENERATE(false, true);
  const CompiledWarp warp = random_warp({dimension, quadratic, copied}, 11);
  const WarpRows rows = count < 1000 ? random_rows(count) : odd_rows(count);
  WarpRows found(count);
  const std::size_t outside =
      kernels(InstructionSet::kBaseline).warp(packed(warp), count, rows.sources(), found.targets());
  CHECK(wrong_texels(warp, rows, found) == 0);
  std::size_t expected_outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const WarpTexel texel = rows.texel(i);
    expected_outside +=
        !std::ranges::all_of(texel, [](float value) { return value >= 0.0f && value <= 1.0f; });
  }
  CHECK(outside == expected_outside);
}

TEST_CASE("warp converter: every instruction set gives the same bits, in place too") {
  constexpr std::size_t kCount = 517;
  const auto dimension = GENERATE(as<std::size_t>{}, 1, 2, 3);
  const bool quadratic = GENERATE(false, true), copied = GENERATE(false, true);
  const PackedWarp pass = packed(random_warp({dimension, quadratic, copied}, 5, 17));
  WarpRows expected(kCount);
  const WarpRows rows = odd_rows(kCount);
  kernels(InstructionSet::kBaseline).warp(pass, kCount, rows.sources(), expected.targets());
  for (const InstructionSet set :
       {InstructionSet::kBaseline, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (set > best_instruction_set()) continue;
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
    REQUIRE(same_rows(found, expected));
    REQUIRE(same_rows(single, expected));
  }
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
