#include <algorithm>
#include <cmath>
#include <random>

#include "generated/materials/materials.hpp"
#include "remap/surface.hpp"
#include "stages/stage.hpp"

namespace remap {
namespace {

using materials::OpenPbrSurface;

// No model has more channels than this.
constexpr std::size_t kMostChannels = 128;
using Values = std::array<float, kMostChannels>;

template <typename Model>
Model model_of_values(const float* values) {
  Model model;
  Model::for_each(model, [&](const char*, auto& value) {
    materials::detail::read(values, value);
    values += sizeof(value) / sizeof(float);
  });
  return model;
}

template <typename Model>
void write_values(const Model& model, float* values) {
  Model::for_each(model, [&](const char*, const auto& value) {
    materials::detail::write(value, values);
    values += sizeof(value) / sizeof(float);
  });
}

template <typename Model, OpenPbrSurface (*kToHub)(const Model&)>
OpenPbrSurface to_hub(const float* values) {
  return kToHub(model_of_values<Model>(values));
}

template <typename Model, Model (*kFromHub)(const OpenPbrSurface&)>
void from_hub(const OpenPbrSurface& hub, float* values) {
  write_values(kFromHub(hub), values);
}

// A SurfaceLink converts between a model and OpenPBR. `from_hub` is null for Principled, which can only be a
// source.
struct SurfaceLink {
  OpenPbrSurface (*to_hub)(const float*);
  void (*from_hub)(const OpenPbrSurface&, float*);
};

SurfaceLink link_of(Surface surface) {
  using namespace materials;
  constexpr auto kOfUsd = to_hub<UsdPreviewSurface, UsdPreviewSurface_to_open_pbr_surface>;
  switch (surface) {
    case Surface::kStandardSurface:
      return {to_hub<StandardSurface, standard_surface_to_open_pbr_surface>,
              from_hub<StandardSurface, open_pbr_surface_to_standard_surface>};
    case Surface::kGltf:
      return {to_hub<GltfPbr, gltf_pbr_to_open_pbr_surface>, from_hub<GltfPbr, open_pbr_surface_to_gltf_pbr>};
    case Surface::kUsdPreview:
      return {kOfUsd, from_hub<UsdPreviewSurface, open_pbr_surface_to_UsdPreviewSurface>};
    case Surface::kUsdPreviewSpecular:
      return {kOfUsd, from_hub<UsdPreviewSurface, open_pbr_surface_to_UsdPreviewSurface_specular>};
    case Surface::kPrincipled:
      return {to_hub<Principled, principled_to_open_pbr_surface>, nullptr};
    case Surface::kOpenPbr:
      break;
  }
  return {model_of_values<OpenPbrSurface>, write_values<OpenPbrSurface>};
}

// Returns the defaults of all inputs, channel by channel.
Values defaults_of(Surface surface) {
  Values values{};
  float* next = values.data();
  for (const SurfaceInput& input : inputs_of(surface))
    next = std::copy_n(input.value.data(), input.channels, next);
  return values;
}

// A Row is one channel of an input in the block.
template <typename Float>
struct Row {
  Float* values;
  std::size_t channel;  // among all channels of the model
};

// Translates the texels of a block. Inputs of the source that it lacks have the values of `defaults`.
void translate(const SurfaceTranslation& translation, const Values& defaults, Block& block) {
  std::vector<Row<const float>> sources;
  std::vector<Row<float>> targets;
  std::size_t channel = 0;
  for (const SurfaceInput& input : inputs_of(translation.source)) {
    if (input.parameter && block.has(*input.parameter))
      for (std::size_t c = 0; c < input.channels; ++c)
        sources.push_back({block.color(*input.parameter)[c], channel + c});
    channel += input.channels;
  }
  channel = 0;
  for (const SurfaceInput& input : inputs_of(translation.target)) {
    if (input.parameter && block.is_wanted(*input.parameter)) {
      const auto rows = block.make_color(*input.parameter, input.channels);
      for (std::size_t c = 0; c < input.channels; ++c) targets.push_back({rows[c], channel + c});
    }
    channel += input.channels;
  }
  const SurfaceLink from = link_of(translation.source), to = link_of(translation.target);
  Values in = defaults, out;
  for (std::size_t i = 0; i < block.size(); ++i) {
    for (const auto& source : sources) in[source.channel] = source.values[i];
    to.from_hub(from.to_hub(in.data()), out.data());
    for (const auto& target : targets) target.values[i] = out[target.channel];
  }
}

// Smaller differences come from rounding, and no picture shows them.
constexpr float kSame = 1e-6f;
// More random materials do not find more dependences.
constexpr std::size_t kProbes = 32;
using Probes = std::array<Values, kProbes>;

bool differ(const float* a, const float* b, std::size_t count) {
  return !std::equal(a, a + count, b, [](float x, float y) { return std::abs(x - y) <= kSame; });
}

// A Probing translates random materials, and compares the results.
class Probing {
 public:
  Probing(const SurfaceTranslation& translation, const GivenInputs& given) : translation_(translation) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform;
    materials_.fill(defaults_of(translation.source));
    std::size_t at = 0;
    for (const SurfaceInput& input : inputs_of(translation.source)) {
      const auto found = input.parameter ? given.find(*input.parameter) : given.end();
      if (found != given.end()) {
        for (Values& material : materials_)
          for (std::size_t c = 0; c < input.channels; ++c)
            material[at + c] =
                !found->second ? uniform(random) : (*found->second)[found->second->size() == 1 ? 0 : c];
        given_.push_back({&input, at, !found->second});
      }
      at += input.channels;
    }
    results_ = translated(materials_);
  }

  TranslationEffect effect() const {
    TranslationEffect effect;
    std::size_t at = 0;
    for (const SurfaceInput& input : inputs_of(translation_.target)) {
      const float* const first = results_[0].data() + at;
      const bool is_map = std::ranges::any_of(
          results_, [&](const Values& result) { return differ(first, result.data() + at, input.channels); });
      if (!is_hidden(input) && is_map && input.parameter) {
        effect.written.push_back(*input.parameter);
        if (is_unchanged(input, at)) effect.unchanged.push_back(*input.parameter);
        if (is_wide(input, at)) effect.wide.push_back(*input.parameter);
      } else if (!is_hidden(input) && differ(first, input.value.data(), input.channels)) {
        effect.values.push_back({std::string(input.name), {first, first + input.channels}});
      }
      at += input.channels;
    }
    std::ranges::sort(effect.written);
    for (const Given& source : given_)
      if (!is_seen(source)) effect.lost.emplace_back(source.input->name);
    return effect;
  }

 private:
  struct Given {
    const SurfaceInput* input;
    std::size_t at;  // first channel
    bool is_map;
  };

  Probes translated(const Probes& materials) const {
    Probes results{};
    for (std::size_t i = 0; i < kProbes; ++i) translation_.run(materials[i].data(), results[i].data());
    return results;
  }

  bool is_all(std::size_t at, std::size_t channels, bool (*holds)(float)) const {
    return std::ranges::all_of(results_, [&](const Values& result) {
      return std::all_of(&result[at], &result[at] + channels, holds);
    });
  }

  bool is_zero(const SurfaceInput& target) const {
    std::size_t at = 0;
    for (const SurfaceInput* input = inputs_of(translation_.target).data(); input != &target; ++input)
      at += input->channels;
    return is_all(at, target.channels, [](float value) { return std::abs(value) <= kSame; });
  }

  // Returns true if the input has no effect. Then the weight of its lobe is 0 in every material. Or it is
  // itself the weight of a lobe, is 0 in every material, and the color of the lobe is black by default.
  bool is_hidden(const SurfaceInput& target) const {
    const auto inputs = inputs_of(translation_.target);
    if (target.weight) return is_zero(inputs[*target.weight]);
    const auto own = static_cast<std::size_t>(&target - inputs.data());
    return is_zero(target) && std::ranges::any_of(inputs, [&](const SurfaceInput& input) {
             return input.weight == own && input.value == std::array<float, 3>{} && input.channels == 3;
           });
  }

  bool is_wide(const SurfaceInput& target, std::size_t at) const {
    return !is_all(at, target.channels, [](float value) { return value >= -kSame && value <= 1.0f + kSame; });
  }

  bool is_unchanged(const SurfaceInput& target, std::size_t at) const {
    const auto own = std::ranges::find_if(given_, [&](const Given& source) {
      return source.is_map && source.input->parameter == target.parameter &&
             source.input->channels == target.channels;
    });
    if (own == given_.end()) return false;
    for (std::size_t i = 0; i < kProbes; ++i)
      if (differ(materials_[i].data() + own->at, results_[i].data() + at, target.channels)) return false;
    return true;
  }

  // Returns true if a result changes with the value of this input, or if the value is the default.
  bool is_seen(const Given& source) const {
    Probes others = materials_;
    for (std::size_t i = 0; i < kProbes; ++i)
      std::copy_n(
          source.is_map ? materials_[(i + 1) % kProbes].data() + source.at : source.input->value.data(),
          source.input->channels, others[i].data() + source.at);
    const float* const own = materials_[0].data() + source.at;
    if (!source.is_map && !differ(own, source.input->value.data(), source.input->channels)) return true;
    const Probes changed = translated(others);
    std::size_t at = 0;
    for (const SurfaceInput& input : inputs_of(translation_.target)) {
      for (std::size_t i = 0; i < kProbes && !is_hidden(input); ++i)
        if (differ(&results_[i][at], &changed[i][at], input.channels)) return true;
      at += input.channels;
    }
    return false;
  }

  const SurfaceTranslation& translation_;
  std::vector<Given> given_;
  Probes materials_, results_;
};

}  // namespace

void SurfaceTranslation::run(const float* source_values, float* target_values) const {
  link_of(target).from_hub(link_of(source).to_hub(source_values), target_values);
}

std::unique_ptr<Converter> make_translation_converter(const SurfaceTranslation& translation,
                                                      ConverterInfo ends) {
  return std::make_unique<Converter>(
      std::move(ends), parameters_of(translation.source), parameters_of(translation.target),
      StageList{make_stage([translation, defaults = defaults_of(translation.source)](Block& block) {
        translate(translation, defaults, block);
      })});
}

TranslationEffect effect_of(const SurfaceTranslation& translation, const GivenInputs& given) {
  return Probing(translation, given).effect();
}

}  // namespace remap
