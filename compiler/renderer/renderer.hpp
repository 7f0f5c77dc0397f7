// A renderer as the sweep sees it: a black box that knows models, parameters and scenes, and gives linear
// images. The built-in renderer is one implementation; nothing in the sweep may look behind this interface.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "model/convention.hpp"
#include "model/fit.hpp"
#include "renderer/image.hpp"
#include "renderer/scene.hpp"

namespace remapc {

// What a parameter does, so that a sweep can turn it without knowing its name.
// A sweep turns the first three; a conductor has an index and an extinction in place of one specular value;
// any other stays at its standard value.
enum class ParameterRole { kRoughness, kSpecular, kDiffuse, kIndex, kExtinction, kOther };
inline constexpr std::array kParameterRoles = {ParameterRole::kRoughness,  ParameterRole::kSpecular,
                                               ParameterRole::kDiffuse,    ParameterRole::kIndex,
                                               ParameterRole::kExtinction, ParameterRole::kOther};

// `roughness`, `specular`, `diffuse`, `index`, `extinction`, `other`.
std::string_view role_word(ParameterRole role);

struct ParameterDescription {
  std::string name;  // the model's own word: alpha, exponent, specular, f0, ior, eta, k, diffuse
  ParameterRole role = ParameterRole::kSpecular;
  remap::Range range;     // values the renderer accepts, in the parameter's own unit
  double standard = 0.0;  // of kOther
  bool grey = false;      // takes one value, never three
};

struct ModelDescription {
  std::string name;  // `renderer/brdf`
  remap::RoughnessConvention roughness = remap::RoughnessConvention::kAlpha;
  remap::Range alpha;  // widths that the model can take, canonical
  std::vector<ParameterDescription> parameters;
  bool noise = false;        // another seed gives another picture
  bool is_external = false;  // of another program: pictures are worth sparing, and claims are checked
  double precision = 0.0;    // relative error of a pixel, where that is more than a float's

  bool has(ParameterRole role) const;
  // Throws kUsage where it has none.
  const ParameterDescription& parameter(ParameterRole role) const;
  // Throws kUsage with the nearest known name.
  const ParameterDescription& parameter(const std::string& parameter_name) const;
};

// A model with values for its parameters: one value for a grey parameter, three for red, green, blue.
struct Material {
  std::string model;
  std::map<std::string, std::vector<double>> parameters;
};

class Renderer {
 public:
  virtual ~Renderer() = default;

  // Name and version of what makes the pictures; part of every cache key and table.
  virtual std::string version() const = 0;
  // The same for one model, where several programs stand behind this renderer.
  virtual std::string version_of(const std::string& model) const;

  virtual std::vector<ModelDescription> models() const = 0;
  // The description of one model. Throws kUsage with the nearest known name.
  virtual ModelDescription model(const std::string& name) const;

  // Radiance of the sphere with `material` in `scene`. One channel where every parameter is grey, else three.
  // Safe to call from many threads. Throws kUsage for a model, parameter or value that the renderer does not
  // know, kInput where it breaks.
  virtual Image render(const Material& material, const Scene& scene) const = 0;
};

// The description of `name`. Throws kUsage with the nearest known name.
ModelDescription find_model(const Renderer& renderer, const std::string& name);

// Throws kUsage for a value that `parameter` of `model` does not take.
void require_value(const ModelDescription& model, const ParameterDescription& parameter, double value);

// Throws kUsage where `material` lacks a parameter of `model`, has one that the model has not, or a value
// that it does not take.
void require_material(const Material& material, const ModelDescription& model);

// A grey material from canonical coordinates: the width as alpha, linear specular and diffuse (of a model
// that has it); other parameters at their standard values.
Material grey_material(const ModelDescription& model, double alpha, double specular, double diffuse);

// Canonical widths of a range of a model's own, ascending: some conventions fall as alpha rises.
remap::Range canonical_widths(remap::RoughnessConvention convention, const remap::Range& own);

// The end of a conversion that `model` stands for.
remap::ModelSide model_side(const ModelDescription& model);

std::unique_ptr<Renderer> make_builtin_renderer();

}  // namespace remapc
