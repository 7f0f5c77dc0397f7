// This file tests what stages do with rows of texels. Translations of whole materials are compared with
// the structs of the generated header, warps with the same warp in double precision, one texel at a time,
// and workflows with closed forms (texremap_workflow_test compares specular to metallic with the
// reference, bit for bit).
#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "generated/materials/materials.hpp"
#include "remap/converter.hpp"
#include "remap/error.hpp"
#include "remap/surface.hpp"
#include "remap/warp.hpp"
#include "stages/kernels.hpp"
#include "stages/stage.hpp"
#include "support/error_of.hpp"
#include "support/random_warp.hpp"
#include "support/warp_rows.hpp"

using namespace remap;

TEST_CASE("instruction set: names lead back to their sets, up to the best") {
  for (const InstructionSet best :
       {InstructionSet::kBaseline, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    const std::vector<InstructionSet> sets = instruction_sets(best);
    CHECK(sets.front() == InstructionSet::kBaseline);
    CHECK(sets.back() == best);
    for (const InstructionSet set : sets)
      CHECK(instruction_set_from_name("place", std::string(instruction_set_name(set)), best) == set);
  }
}

TEST_CASE("instruction set: one that the processor lacks, or that there is not, is wrong usage") {
  const auto message = [](const std::string& name) {
    return error_of([&] { instruction_set_from_name("--instructions", name, InstructionSet::kAvx2); },
                    ErrorKind::kUsage);
  };
  CHECK(message("avx512") == "--instructions: this processor does not support avx512 (choose avx2 or less)");
  CHECK(message("avx") == "--instructions: unknown instruction set 'avx' (did you mean avx2?)");
}

namespace {

constexpr std::array kSurfaces = {Surface::kOpenPbr,    Surface::kStandardSurface,    Surface::kGltf,
                                  Surface::kUsdPreview, Surface::kUsdPreviewSpecular, Surface::kPrincipled};

std::vector<std::string> names(const std::vector<Parameter>& parameters) {
  std::vector<std::string> all;
  for (const Parameter parameter : parameters) all.push_back(plain_name(parameter));
  return all;
}

std::vector<float> random_material(Surface surface, std::mt19937& random) {
  std::uniform_real_distribution<float> uniform;
  std::vector<float> values;
  for (const SurfaceInput& input : inputs_of(surface))
    for (std::size_t c = 0; c < input.channels; ++c)
      values.push_back(input.parameter ? uniform(random) : input.value[c]);
  return values;
}

template <typename Model>
Model filled(const std::vector<float>& values) {
  Model model;
  const float* next = values.data();
  Model::for_each(model, [&](const char*, auto& value) {
    materials::detail::read(next, value);
    next += sizeof(value) / sizeof(float);
  });
  return model;
}

template <typename Model>
std::vector<float> flat(const Model& model) {
  std::vector<float> values;
  Model::for_each(model, [&](const char*, const auto& value) {
    std::array<float, 3> channels{};
    materials::detail::write(value, channels.data());
    values.insert(values.end(), channels.begin(), channels.begin() + sizeof(value) / sizeof(float));
  });
  return values;
}

// Requires that a translation equals a function of the header.
template <typename Source, typename Target>
void require_equal(Surface from, Surface to, Target (*function)(const Source&)) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const std::vector<float> source = random_material(from, random);
    std::vector<float> expected = flat(function(filled<Source>(source))), found(expected.size());
    SurfaceTranslation{from, to}.run(source.data(), found.data());
    REQUIRE(found == expected);
  }
}

}  // namespace

TEST_CASE("translation: the flat form equals the functions of the header") {
  using namespace materials;
  require_equal(Surface::kPrincipled, Surface::kOpenPbr, principled_to_open_pbr_surface);
  require_equal(Surface::kStandardSurface, Surface::kOpenPbr, standard_surface_to_open_pbr_surface);
  require_equal(Surface::kGltf, Surface::kOpenPbr, gltf_pbr_to_open_pbr_surface);
  require_equal(Surface::kUsdPreview, Surface::kOpenPbr, UsdPreviewSurface_to_open_pbr_surface);
  require_equal(Surface::kUsdPreviewSpecular, Surface::kOpenPbr, UsdPreviewSurface_to_open_pbr_surface);
  require_equal(Surface::kOpenPbr, Surface::kStandardSurface, open_pbr_surface_to_standard_surface);
  require_equal(Surface::kOpenPbr, Surface::kGltf, open_pbr_surface_to_gltf_pbr);
  require_equal(Surface::kOpenPbr, Surface::kUsdPreview, open_pbr_surface_to_UsdPreviewSurface);
  require_equal(Surface::kOpenPbr, Surface::kUsdPreviewSpecular,
                open_pbr_surface_to_UsdPreviewSurface_specular);
  const auto chain = +[](const Principled& source) {
    return open_pbr_surface_to_standard_surface(principled_to_open_pbr_surface(source));
  };
  require_equal(Surface::kPrincipled, Surface::kStandardSurface, chain);
}

TEST_CASE("translation: every input of a model has its own parameter, and every name is known") {
  for (const Surface surface : kSurfaces) {
    std::set<Parameter> parameters;
    for (const SurfaceInput& input : inputs_of(surface)) {
      INFO(input.name);
      if (!input.parameter) continue;
      CHECK(parameters.insert(*input.parameter).second);
      CHECK(is_color(*input.parameter) == (input.channels == 3));
      // If several parameters have this name, this is the one that most models have.
      const auto named = parameter_named(input.name);
      const bool is_other = input.name == "specular" || is_color(*named) != is_color(*input.parameter);
      if (surface != Surface::kUsdPreviewSpecular && !is_other) CHECK(named == input.parameter);
    }
    CHECK(parameters.contains(Parameter::kRoughness));
  }
  CHECK(parameter_named("clearcoat") == parameter_named("coat_weight"));
  CHECK(parameter_named("specular") == Parameter::kSpecular);
  CHECK_FALSE(parameter_named("colour"));
}

TEST_CASE("translation: the effect on a set of maps is found") {
  const Parameter coat = *parameter_named("coat_weight"), fuzz = *parameter_named("fuzz_weight");
  const GivenInputs plain = {
      {Parameter::kBaseColor, {}}, {Parameter::kRoughness, {}}, {Parameter::kMetallic, {}}};

  const TranslationEffect blender = effect_of({Surface::kPrincipled, Surface::kOpenPbr}, plain);
  CHECK(blender.unchanged.size() == 3);
  CHECK(blender.lost.empty());

  GivenInputs given = plain;
  given[coat] = std::nullopt;
  given[fuzz] = std::vector<float>{0.5f};
  const TranslationEffect usd = effect_of({Surface::kOpenPbr, Surface::kUsdPreview}, given);
  CHECK(names(usd.written) ==
        std::vector<std::string>{"roughness", "base_color", "metallic", "ior", "coat_weight"});
  CHECK(usd.lost == std::vector<std::string>{"fuzz_weight"});

  // Without a coat, the color of the coat has no effect.
  const TranslationEffect hidden =
      effect_of({Surface::kOpenPbr, Surface::kStandardSurface},
                {{Parameter::kBaseColor, {}}, {*parameter_named("coat_color"), {}}});
  CHECK(hidden.lost == std::vector<std::string>{"coat_color"});

  // If only numbers are given, the result lists every value that is not the default.
  const TranslationEffect numbers = effect_of({Surface::kUsdPreview, Surface::kOpenPbr},
                                              {{Parameter::kRoughness, std::vector<float>{0.4f}}});
  CHECK(numbers.written.empty());
  const auto found = std::ranges::find(numbers.values, "specular_roughness", &SurfaceValue::name);
  REQUIRE(found != numbers.values.end());
  CHECK(found->values == std::vector<float>{0.4f});
}

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
