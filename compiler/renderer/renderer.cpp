#include "renderer/renderer.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "core/system.hpp"

namespace remap {
namespace {

// These words are in the order of ParameterRole. Messages and the protocol use them.
constexpr std::array<const char*, 6> kRoleNames = {"roughness",           "specular",   "diffuse",
                                                   "index of refraction", "extinction", "anything else"};
constexpr std::array<std::string_view, 6> kRoleWords = {"roughness", "specular",   "diffuse",
                                                        "index",     "extinction", "other"};

// Converts alpha to the model's own parameter. If rounding gives a value just outside of the range, returns
// the end of the range.
double own_width(const ModelDescription& model, double alpha) {
  const Range range = model.parameter(ParameterRole::kRoughness).range;
  const double own = from_alpha(model.roughness, alpha);
  const double clamped = std::clamp(own, range.min, range.max);
  return std::fabs(own - clamped) <= 1e-12 * std::fabs(clamped) ? clamped : own;
}

constexpr int kResolution = 128;
// At this width the highlight covers about a hundred pixels.
constexpr double kNarrowWidth = 0.3;

// Returns the noise of one picture, computed from two pictures with different seeds. Their difference has
// sqrt(2) times the error of one.
Noise difference(const Image& a, const Image& b) {
  if (a.values.size() != b.values.size()) return {};  // PictureTaker reports pictures of the wrong size
  double apart = 0.0, power = 0.0, largest = 0.0, brightest = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double x = a.values[i], y = b.values[i], mean = 0.5 * (x + y);
    apart += 0.5 * (x - y) * (x - y);
    power += mean * mean;
    largest = std::max(largest, std::fabs(x - y) / std::sqrt(2.0));
    brightest = std::max(brightest, mean);
  }
  if (!(power > 0.0)) return {};
  return {std::sqrt(apart / power), largest / brightest, 1};
}

std::string percent(double share) { return number_text(rounded(100.0 * share, 2)) + " %"; }

Noise measure(const Renderer& renderer, const ModelDescription& model, const Light& light) {
  Noise noise;
  const double full = model.parameter(ParameterRole::kSpecular).range.max;
  for (const double alpha : {std::clamp(kNarrowWidth, model.alpha.min, model.alpha.max), model.alpha.max}) {
    const Material material = grey_material(model, alpha, full, 0.0);
    const Noise found = difference(renderer.render(material, {kResolution, 1, light, 0}),
                                   renderer.render(material, {kResolution, 1, light, 1}));
    noise.level = std::max(noise.level, found.level);
    noise.largest = std::max(noise.largest, found.largest);
  }
  const double needed = std::ceil(noise.level * noise.level / (kSteadyNoise * kSteadyNoise));
  if (needed > kMostSeeds)
    throw input_error(model.name + ": pictures of two seeds differ by " + percent(noise.level) + " rms; " +
                      number_text(needed) +
                      " pictures would have to be averaged to reduce this difference to " +
                      percent(kSteadyNoise) + ", the limit is " + std::to_string(kMostSeeds) +
                      " (use a model without noise, or more samples per pixel in the worker)");
  noise.pictures = std::max(1, static_cast<int>(needed));
  return noise;
}

}  // namespace

std::string_view role_word(ParameterRole role) { return kRoleWords[static_cast<std::size_t>(role)]; }

bool ModelDescription::has(ParameterRole role) const {
  return std::ranges::any_of(
      parameters, [&](const ParameterDescription& description) { return description.role == role; });
}

const ParameterDescription& ModelDescription::parameter(ParameterRole role) const {
  for (const ParameterDescription& description : parameters)
    if (description.role == role) return description;
  throw usage_error(name + ": has no parameter for " + kRoleNames[static_cast<std::size_t>(role)] +
                    " (remapc list --models shows the parameters of every model)");
}

const ParameterDescription& ModelDescription::parameter(const std::string& parameter_name) const {
  std::vector<std::string> names;
  for (const ParameterDescription& description : parameters) {
    if (description.name == parameter_name) return description;
    names.push_back(description.name);
  }
  throw usage_error(name + ": has no parameter " + parameter_name + suggestion(parameter_name, names));
}

std::string Renderer::version_of(const std::string&) const { return version(); }

ModelDescription Renderer::model(const std::string& name) const {
  std::vector<std::string> names;
  for (const ModelDescription& model : models()) {
    if (model.name == name) return model;
    names.push_back(model.name);
  }
  throw usage_error(name + ": unknown model of " + version() + suggestion(name, names));
}

void require_value(const ModelDescription& model, const ParameterDescription& parameter, double value) {
  if (parameter.range.contains(value)) return;
  throw usage_error(model.name + ": " + parameter.name + " = " + number_text(value) + " is out of range (" +
                    number_text(parameter.range.min) + " to " + number_text(parameter.range.max) + ")");
}

namespace {

[[noreturn]] void fail(const ModelDescription& model, const std::string& what) {
  throw usage_error(model.name + ": " + what);
}

void require_map(const Image& map, const ModelDescription& model, const ParameterDescription& parameter) {
  if (!model.textures || parameter.role == ParameterRole::kOther)
    fail(model, "parameter " + parameter.name + " accepts no map (give a number)");
  const auto texels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  const bool is_one = parameter.grey || parameter.role == ParameterRole::kRoughness;
  if (map.channels != 1 && (is_one || map.channels != 3))
    fail(model, "the map of " + parameter.name + " has " + std::to_string(map.channels) + " channels (give " +
                    (is_one ? "1" : "1 or 3") + ")");
  if (texels == 0 || map.values.size() != texels * static_cast<std::size_t>(map.channels))
    fail(model, "the map of " + parameter.name + " is incomplete (give a value for each texel)");
  for (const float value : map.values) require_value(model, parameter, static_cast<double>(value));
}

}  // namespace

void require_material(const Material& material, const ModelDescription& model) {
  std::vector<std::string> names;
  for (const ParameterDescription& parameter : model.parameters) names.push_back(parameter.name);
  for (const auto& entry : material.parameters)
    if (std::ranges::find(names, entry.first) == names.end())
      fail(model, "has no parameter " + entry.first + suggestion(entry.first, names));
  for (const ParameterDescription& parameter : model.parameters) {
    if (const auto map = material.maps.find(parameter.name); map != material.maps.end()) {
      require_map(map->second, model, parameter);
      continue;
    }
    const auto found = material.parameters.find(parameter.name);
    if (found == material.parameters.end()) fail(model, "parameter " + parameter.name + " has no value");
    const std::vector<double>& values = found->second;
    const bool is_one = parameter.grey || parameter.role == ParameterRole::kRoughness;
    if (values.size() != 1 && (is_one || values.size() != 3))
      fail(model, "parameter " + parameter.name + " has " + std::to_string(values.size()) + " values (give " +
                      (is_one ? "1" : "1 or 3") + ")");
    for (const double value : values) require_value(model, parameter, value);
  }
}

Material grey_material(const ModelDescription& model, double alpha, double specular, double diffuse) {
  Material material{model.name,
                    {{model.parameter(ParameterRole::kRoughness).name, {own_width(model, alpha)}},
                     {model.parameter(ParameterRole::kSpecular).name, {specular}}}};
  for (const ParameterDescription& parameter : model.parameters) {
    if (parameter.role == ParameterRole::kDiffuse) material.parameters[parameter.name] = {diffuse};
    if (parameter.role == ParameterRole::kOther) material.parameters[parameter.name] = {parameter.standard};
  }
  return material;
}

Range canonical_widths(RoughnessEncoding convention, const Range& own) {
  const double a = to_alpha(convention, own.min), b = to_alpha(convention, own.max);
  return {std::min(a, b), std::max(a, b)};
}

ModelSide model_side(const ModelDescription& model) {
  return {model.name, model.roughness, model.parameter(ParameterRole::kSpecular).name};
}

Image TimedRenderer::render(const Material& material, const Scene& scene) const {
  const Stopwatch stopwatch;
  Image image = inner_.render(material, scene);
  seconds_ += stopwatch.seconds();
  ++pictures_;
  return image;
}

SteadyRenderer::SteadyRenderer(const Renderer& inner, const std::vector<std::string>& models,
                               const Light& light)
    : inner_(inner) {
  for (const std::string& name : models) {
    const ModelDescription model = inner.model(name);
    if (model.is_external && !noise_.contains(name)) noise_[name] = measure(inner, model, light);
  }
}

ModelDescription SteadyRenderer::model(const std::string& name) const {
  ModelDescription model = inner_.model(name);
  if (const auto found = noise_.find(name); found != noise_.end()) {
    const Noise& noise = found->second;
    model.precision =
        std::max(model.precision, noise.largest / std::sqrt(static_cast<double>(noise.pictures)));
  }
  return model;
}

Image SteadyRenderer::render(const Material& material, const Scene& scene) const {
  const auto found = noise_.find(material.model);
  const int pictures = found == noise_.end() ? 1 : found->second.pictures;
  Image mean = inner_.render(material, scene);
  if (pictures == 1) return mean;
  std::vector<double> sums(mean.values.begin(), mean.values.end());
  for (int i = 1; i < pictures; ++i) {
    Scene again = scene;
    again.seed += i;
    const Image image = inner_.render(material, again);
    for (std::size_t p = 0; p < sums.size(); ++p) sums[p] += image.values[p];
  }
  std::transform(sums.begin(), sums.end(), mean.values.begin(),
                 [&](double sum) { return static_cast<float>(sum / pictures); });
  return mean;
}

}  // namespace remap
