#include "look/material_looks.hpp"

#include "core/errors.hpp"
#include "look/image_similarity.hpp"
#include "look/scene.hpp"

namespace remap {

PictureError picture_error(const DisplayedSphere& source, const DisplayedSphere& other,
                           std::span<const std::uint32_t> pixels, int resolution) {
  return {sphere_similarity(source, other, pixels, resolution), rms_difference(source.colors, other.colors)};
}

LitLooks light(const MaterialLooks& looks, const BallRenderer& render, int resolution) {
  std::vector<TexturedBall> balls = {looks.source};
  if (looks.copied) balls.push_back(*looks.copied);
  balls.push_back(looks.converted);
  const std::vector<std::uint32_t> pixels = shape_pixels(Shape::kSphere, resolution);
  LitLooks lit;
  for (const auto& picture : render(balls, looks.normals))
    lit.pictures.push_back(displayed_sphere(picture, pixels, resolution));
  const auto error = [&](const DisplayedSphere& other) {
    return picture_error(lit.pictures.front(), other, pixels, resolution);
  };
  if (looks.copied) lit.copied = error(lit.pictures[1]);
  lit.converted = error(lit.pictures.back());
  return lit;
}

ShownModel::ShownModel(const std::string& model, const ConverterGraph& graph, const ModelTest& has)
    : name_(model) {
  if (has(model)) return;
  std::vector<ConverterPath> paths;
  for (const std::string& other : graph.reachable_from(model))
    if (has(other)) paths.push_back(graph.find_paths({model, other, {}}).front());
  if (paths.empty())
    throw input_error(model +
                      ": no converter leads from it to a model that can be shown (choose another renderer)");
  const ConverterPath& closest = closest_path(paths);
  to_shown_ = make_chained_converter(closest.steps);
  name_ = target_model(closest);
}

TexturedBall ShownModel::ball(const std::optional<WorkflowEnd>& workflow, ScaledMaps maps) const {
  if (workflow) {
    const SpecularWorkflow plain{"specular", DiffuseConvention::kPlain, RoughnessEncoding::kAlpha};
    const WorkflowStages stages{*workflow, plain, nullptr, RoughnessEncoding::kAlpha};
    maps = converted(*make_workflow_converter(stages), std::move(maps));
    maps.encoding = RoughnessEncoding::kAlpha;
  }
  if (to_shown_ != nullptr) {
    std::vector<std::vector<float>> diffuse = std::move(maps.rows[Parameter::kDiffuse]);
    maps = converted(*to_shown_, std::move(maps));
    maps.rows[Parameter::kDiffuse] = std::move(diffuse);
  }
  return ball_of(name_, std::move(maps));
}

}  // namespace remap
