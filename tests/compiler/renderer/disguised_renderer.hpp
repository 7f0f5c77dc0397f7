// This file makes substitutes for closed renderers: the built-in renderer with other names, scales, laws and
// lights.
#pragma once

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compiler/renderer/oren_nayar.hpp"
#include "renderer/renderer.hpp"

namespace remap {

// A DisguisedRenderer is the built-in renderer with one additional model. This model acts like one of a
// closed renderer.
class DisguisedRenderer : public Renderer {
 public:
  std::string version() const override { return "disguised"; }
  std::vector<ModelDescription> models() const override {
    auto all = builtin().models();
    all.push_back(disguise());
    return all;
  }
  Image render(const Material& material, const Scene& scene) const override {
    return material.model == disguise().name ? render_disguise(material, scene)
                                             : builtin().render(material, scene);
  }

 protected:
  virtual ModelDescription disguise() const = 0;
  virtual Image render_disguise(const Material& material, const Scene& scene) const = 0;
  const Renderer& builtin() const { return *builtin_; }

 private:
  std::unique_ptr<Renderer> builtin_ = make_builtin_renderer();
};

// A BothRenderers also has `disguised/metal`: Ward with another name and scale for every parameter, and light
// of an unknown strength.
class BothRenderers final : public DisguisedRenderer {
 public:
  explicit BothRenderers(double light = 0.5) : light_(light) {}

 private:
  ModelDescription disguise() const override {
    return {"disguised/metal",
            RoughnessEncoding::kGlossiness,
            {1e-3, 1.0},
            {{"gloss", ParameterRole::kRoughness, {0.0, 1.0}},
             {"shine", ParameterRole::kSpecular, {0.0, 4.0}},
             {"paint", ParameterRole::kDiffuse, {0.0, 1.0}}}};
  }
  Image render_disguise(const Material& material, const Scene& scene) const override {
    const double alpha = to_alpha(RoughnessEncoding::kGlossiness, material.parameters.at("gloss")[0]);
    const double shine = material.parameters.at("shine")[0], paint = material.parameters.at("paint")[0];
    Image image = builtin().render(
        {"mitsuba/ward", {{"alpha", {alpha * 0.8}}, {"specular", {shine / 4.0}}, {"diffuse", {paint}}}},
        scene);
    for (float& value : image.values) value = static_cast<float>(value * light_);
    return image;
  }

  double light_;
};

// A ClayRenderer also has `disguised/clay`: GGX on a diffuse lobe of Oren and Nayar.
class ClayRenderer final : public DisguisedRenderer {
 public:
  explicit ClayRenderer(double sigma) : sigma_(sigma) {}

 private:
  ModelDescription disguise() const override {
    ModelDescription changed = builtin().model("mitsuba/ggx");
    changed.name = "disguised/clay";
    return changed;
  }
  Image render_disguise(const Material& material, const Scene& scene) const override {
    Material glossy = material;
    glossy.model = "mitsuba/ggx";
    glossy.parameters["diffuse"] = {0.0};
    Image image = builtin().render(glossy, scene);
    const Image clay = oren_nayar_picture(scene, sigma_);
    const auto diffuse = static_cast<float>(material.parameters.at("diffuse")[0]);
    for (std::size_t i = 0; i < clay.values.size(); ++i) image.values[i] += diffuse * clay.values[i];
    return image;
  }

  double sigma_;
};

// A LawRenderer also has `disguised/law`: the model `inner`, whose specular is a given function of the
// parameter, over `range`.
class LawRenderer final : public DisguisedRenderer {
 public:
  LawRenderer(std::string inner, Range range, std::function<double(double)> law)
      : inner_(std::move(inner)), range_(range), law_(std::move(law)) {}

 private:
  ModelDescription disguise() const override {
    ModelDescription changed = builtin().model(inner_);
    changed.name = "disguised/law";
    for (ParameterDescription& parameter : changed.parameters)
      if (parameter.role == ParameterRole::kSpecular) parameter = {"level", parameter.role, range_};
    return changed;
  }
  Image render_disguise(const Material& material, const Scene& scene) const override {
    const ModelDescription model = builtin().model(inner_);
    Material inner = material;
    inner.model = inner_;
    inner.parameters.erase("level");
    inner.parameters[model.parameter(ParameterRole::kSpecular).name] = {
        law_(material.parameters.at("level")[0])};
    return builtin().render(inner, scene);
  }

  std::string inner_;
  Range range_;
  std::function<double(double)> law_;
};

// A BlendRenderer has only `disguised/blend`: the sum of pictures of built-in models, each with its own
// width, times functions of one specular parameter. The shape of the picture depends on specular, not only
// its strength. It refuses widths out of range, as real renderers do, and counts its pictures.
class BlendRenderer final : public DisguisedRenderer {
 public:
  struct Term {
    std::string model;  // a built-in model, rendered at full specular without diffuse
    double width;       // its alpha, relative to the alpha of the blend
    std::function<double(double)> weight;
  };

  BlendRenderer(std::vector<Term> terms, Range speculars) : terms_(std::move(terms)), speculars_(speculars) {}

  std::size_t pictures() const { return pictures_; }

 private:
  ModelDescription disguise() const override {
    return {"disguised/blend",
            RoughnessEncoding::kAlpha,
            {0.05, 0.8},
            {{"alpha", ParameterRole::kRoughness, {0.05, 0.8}},
             {"level", ParameterRole::kSpecular, speculars_, 0.0, true}}};
  }
  Image render_disguise(const Material& material, const Scene& scene) const override {
    require_material(material, disguise());
    ++pictures_;
    const double alpha = material.parameters.at("alpha")[0], level = material.parameters.at("level")[0];
    std::vector<double> sums;
    Image image;
    for (const Term& term : terms_) {
      const ModelDescription model = builtin().model(term.model);
      image = builtin().render(grey_material(model, alpha * term.width, 1.0, 0.0), scene);
      sums.resize(image.values.size());
      const double weight = term.weight(level);
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += weight * static_cast<double>(image.values[i]);
    }
    image.values.assign(sums.begin(), sums.end());
    return image;
  }

  std::vector<Term> terms_;
  Range speculars_;
  mutable std::atomic<std::size_t> pictures_{0};
};

}  // namespace remap
