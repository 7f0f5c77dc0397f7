// This file is the interface of a renderer: a black box with models, parameters and scenes that returns
// linear images. The built-in renderer and workers implement it. A sweep needs nothing else from a renderer.
// Two renderers wrap another one: one counts its pictures, and one averages noise over several seeds.
#pragma once

#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "look/image.hpp"
#include "look/scene.hpp"
#include "lower/fit.hpp"
#include "remap/model.hpp"

namespace remap {

// A ParameterRole is what a parameter does, so that a sweep can vary it without knowing its name. A sweep
// varies the first three. Conductors have an index and an extinction instead of one specular value. kOther
// keeps its standard value.
enum class ParameterRole { kRoughness, kSpecular, kDiffuse, kIndex, kExtinction, kOther };
inline constexpr std::array kParameterRoles = {ParameterRole::kRoughness,  ParameterRole::kSpecular,
                                               ParameterRole::kDiffuse,    ParameterRole::kIndex,
                                               ParameterRole::kExtinction, ParameterRole::kOther};

// Returns `roughness`, `specular`, `diffuse`, `index`, `extinction` or `other`.
std::string_view role_word(ParameterRole role);

struct ParameterDescription {
  std::string name;  // as the model calls it: alpha, exponent, specular, f0, ior, eta, k, diffuse
  ParameterRole role = ParameterRole::kSpecular;
  Range range;            // values the renderer accepts, in the parameter's own unit
  double standard = 0.0;  // the value of a kOther parameter that nobody sets
  bool grey = false;      // takes one value and refuses three
};

struct ModelDescription {
  std::string name;  // such as `mitsuba3/ggx`
  RoughnessEncoding roughness = RoughnessEncoding::kAlpha;
  Range alpha;  // widths that the model accepts, as alpha
  std::vector<ParameterDescription> parameters;
  bool noise = false;        // true if the picture depends on the seed
  bool is_external = false;  // another program renders it, so pictures take long and its claims are checked
  bool textures = false;     // accepts maps, and an environment as light
  double precision = 0.0;    // relative error of a pixel; 0 if it is no larger than the error of a float

  bool has(ParameterRole role) const;
  // Returns the parameter. Throws kUsage if the model has no parameter of that role.
  const ParameterDescription& parameter(ParameterRole role) const;
  // Returns the parameter. For an unknown name, throws kUsage with the closest name.
  const ParameterDescription& parameter(const std::string& parameter_name) const;
};

// A Material is a model with a value for each parameter: one value for grey, three for red, green, blue.
// Instead of a value, a parameter of a model with `textures` may have a map (PROTOCOL.md describes where it
// lies on the sphere), except parameters of the role kOther.
struct Material {
  std::string model;
  std::map<std::string, std::vector<double>> parameters;
  std::map<std::string, Image> maps = {};
};

class Renderer {
 public:
  virtual ~Renderer() = default;

  // Returns name and version of the renderer. They are part of every cache key and recorded in every table.
  virtual std::string version() const = 0;
  // Returns name and version of the program that renders `model`, if this renderer combines several.
  virtual std::string version_of(const std::string& model) const;

  virtual std::vector<ModelDescription> models() const = 0;
  // Returns the description of one model. For an unknown name, throws kUsage with the closest name.
  virtual ModelDescription model(const std::string& name) const;

  // Renders the sphere with `material` in `scene`, as radiance: one channel if every parameter is grey,
  // otherwise three. Thread-safe. Throws kUsage for an unknown model or parameter or a value out of range,
  // and kInput if the renderer fails.
  virtual Image render(const Material& material, const Scene& scene) const = 0;
};

// Throws kUsage if `parameter` of `model` does not accept `value`.
void require_value(const ModelDescription& model, const ParameterDescription& parameter, double value);

// Throws kUsage if `material` lacks a parameter of `model`, has an unknown one, or has a value out of range.
void require_material(const Material& material, const ModelDescription& model);

// Makes a grey material from canonical values: the width as alpha, linear specular, linear diffuse (ignored
// by models without diffuse). Other parameters get their standard values.
Material grey_material(const ModelDescription& model, double alpha, double specular, double diffuse);

// Converts a range of a model's own width to alpha, ascending, because some widths fall as alpha rises.
Range canonical_widths(RoughnessEncoding convention, const Range& own);

// Describes `model` as the source or target of a conversion.
ModelSide model_side(const ModelDescription& model);

std::unique_ptr<Renderer> make_builtin_renderer();

// A TimedRenderer renders like `inner`. Its seconds are the time that callers waited, summed over threads.
class TimedRenderer final : public Renderer {
 public:
  explicit TimedRenderer(const Renderer& inner) : inner_(inner) {}

  std::size_t picture_count() const { return pictures_; }
  double seconds() const { return seconds_; }

  std::string version() const override { return inner_.version(); }
  std::string version_of(const std::string& model) const override { return inner_.version_of(model); }
  std::vector<ModelDescription> models() const override { return inner_.models(); }
  ModelDescription model(const std::string& name) const override { return inner_.model(name); }
  Image render(const Material& material, const Scene& scene) const override;

 private:
  const Renderer& inner_;
  mutable std::atomic<std::size_t> pictures_ = 0;
  mutable std::atomic<double> seconds_ = 0.0;
};

// A Noise states how much the pictures of a model depend on the seed.
struct Noise {
  double level = 0.0;    // RMS difference from the mean over seeds, relative to the RMS of the picture
  double largest = 0.0;  // largest difference of one pixel, relative to the brightest pixel
  int pictures = 1;      // number of pictures that reduces the level to kSteadyNoise
};

// A match sums over thousands of pixels, so this level changes it by about 1e-4.
inline constexpr double kSteadyNoise = 0.01;
// Averaging more pictures than this makes a sweep too slow.
inline constexpr int kMostSeeds = 64;

// A SteadyRenderer renders like `inner`. It measures the noise of external models, because descriptions may
// be wrong, and averages the pictures of noisy models over as many seeds as needed. Pictures of other models
// are returned unchanged.
class SteadyRenderer final : public Renderer {
 public:
  // Measures the noise of the external models among `models` under `light`. For each model, compares two
  // pictures of 128 x 128 pixels at each of two widths. Throws kInput if more than kMostSeeds pictures would
  // be needed, and kUsage for unknown models.
  SteadyRenderer(const Renderer& inner, const std::vector<std::string>& models, const Light& light);

  // Returns the noise of a model that was measured.
  const Noise& noise(const std::string& model) const { return noise_.at(model); }
  bool measured(const std::string& model) const { return noise_.contains(model); }

  std::string version() const override { return inner_.version(); }
  std::string version_of(const std::string& model) const override { return inner_.version_of(model); }
  std::vector<ModelDescription> models() const override { return inner_.models(); }
  // Returns the description. Its precision includes the noise that remains after averaging.
  ModelDescription model(const std::string& name) const override;
  Image render(const Material& material, const Scene& scene) const override;

 private:
  const Renderer& inner_;
  std::map<std::string, Noise> noise_;
};

}  // namespace remap
