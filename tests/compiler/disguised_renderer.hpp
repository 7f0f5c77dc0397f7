// Renderers in disguise: the built-in one behind other names, scales, laws and lights, as a closed renderer
// meets the sweep.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sweep/renderer.hpp"

namespace remapc {

// The built-in renderer, and beside it `disguised/metal`: Ward with another name and scale for every
// parameter, and light of a strength that the sweep does not know.
class BothRenderers final : public Renderer {
 public:
  explicit BothRenderers(double light = 0.5) : light_(light) {}

  std::string version() const override { return "both"; }
  std::vector<ModelDescription> models() const override {
    auto all = builtin_->models();
    all.push_back({"disguised/metal",
                   remap::RoughnessConvention::kGlossiness,
                   {1e-3, 1.0},
                   {{"gloss", ParameterRole::kRoughness, {0.0, 1.0}},
                    {"shine", ParameterRole::kSpecular, {0.0, 4.0}},
                    {"paint", ParameterRole::kDiffuse, {0.0, 1.0}}}});
    return all;
  }
  Image render(const Material& material, const Scene& scene) const override {
    if (material.model != "disguised/metal") return builtin_->render(material, scene);
    const double alpha =
        remap::to_alpha(remap::RoughnessConvention::kGlossiness, material.parameters.at("gloss")[0]);
    const double shine = material.parameters.at("shine")[0], paint = material.parameters.at("paint")[0];
    Image image = builtin_->render(
        {"mitsuba/ward", {{"alpha", {alpha * 0.8}}, {"specular", {shine / 4.0}}, {"diffuse", {paint}}}},
        scene);
    for (float& value : image.values) value = static_cast<float>(value * light_);
    return image;
  }

 private:
  double light_;
  std::unique_ptr<Renderer> builtin_ = make_builtin_renderer();
};

// The built-in renderer, and beside it `disguised/law`: `inner` with its specular parameter replaced by a
// function of the one that is given, over `range`.
class LawRenderer final : public Renderer {
 public:
  LawRenderer(std::string inner, remap::Range range, std::function<double(double)> law)
      : inner_(std::move(inner)), range_(range), law_(std::move(law)) {}

  std::string version() const override { return "law"; }
  std::vector<ModelDescription> models() const override {
    auto all = builtin_->models();
    ModelDescription changed = find_model(*builtin_, inner_);
    changed.name = "disguised/law";
    for (ParameterDescription& parameter : changed.parameters)
      if (parameter.role == ParameterRole::kSpecular) parameter = {"level", parameter.role, range_};
    all.push_back(changed);
    return all;
  }
  Image render(const Material& material, const Scene& scene) const override {
    if (material.model != "disguised/law") return builtin_->render(material, scene);
    const ModelDescription model = find_model(*builtin_, inner_);
    Material inner = material;
    inner.model = inner_;
    inner.parameters.erase("level");
    inner.parameters[model.parameter(ParameterRole::kSpecular).name] = {
        law_(material.parameters.at("level")[0])};
    return builtin_->render(inner, scene);
  }

 private:
  std::string inner_;
  remap::Range range_;
  std::function<double(double)> law_;
  std::unique_ptr<Renderer> builtin_ = make_builtin_renderer();
};

}  // namespace remapc
