// This file tests translations of whole materials. It compares the flat form of surfaces with the structs of
// the generated header, and tests what a translation makes of a set of maps.
#include <algorithm>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "generated/materials/materials.hpp"
#include "remap/surface.hpp"

using namespace remap;

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
