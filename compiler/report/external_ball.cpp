#include "report/external_ball.hpp"

#include <algorithm>
#include <functional>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/report_text.hpp"

namespace remap {
namespace {

// Texels that are out of range by less than this fraction of the range get no note, because nobody sees it.
constexpr double kUnseenExcess = 0.005;

// Sets a parameter of a material to a map of `value(texel)`, in the range that the model accepts.
void set_map(const ModelDescription& model, ParameterRole role, const TexturedBall& ball,
             const std::function<Rgb(const BallTexel&)>& value, Material& material,
             std::vector<std::string>& notes) {
  const ParameterDescription& parameter = model.parameter(role);
  const bool is_one = parameter.grey || role == ParameterRole::kRoughness;
  const auto least = static_cast<float>(parameter.range.min), most = static_cast<float>(parameter.range.max);
  const double unseen = kUnseenExcess * (parameter.range.max - parameter.range.min);
  Image map{ball.width, ball.height, is_one ? 1 : 3, {}};
  std::size_t beyond = 0;
  for (const BallTexel& texel : ball.texels) {
    Rgb color = value(texel);
    if (is_one) color[0] = (color[0] + color[1] + color[2]) / 3.0;
    bool is_beyond = false;
    for (std::size_t c = 0; c < static_cast<std::size_t>(map.channels); ++c) {
      is_beyond |= color[c] < parameter.range.min - unseen || color[c] > parameter.range.max + unseen;
      map.values.push_back(std::clamp(static_cast<float>(color[c]), least, most));
    }
    if (is_beyond) ++beyond;
  }
  if (beyond > 0)
    add_note(notes,
             model.name + ": " + parameter.name + " of " +
                 fixed(100.0 * static_cast<double>(beyond) / static_cast<double>(ball.texels.size()), 1) +
                 " % of the texels are out of range, and are shown as the closest value in " +
                 number_text(parameter.range.min) + " to " + number_text(parameter.range.max));
  material.parameters.erase(parameter.name);
  material.maps[parameter.name] = std::move(map);
}

Rgb diffuse_of(const BallTexel& texel) { return texel.diffuse; }

bool has_diffuse(const TexturedBall& ball) {
  return std::ranges::any_of(ball.texels, [](const BallTexel& texel) { return texel.diffuse != Rgb{}; });
}

// Returns a material with the least specular and no diffuse.
Material dark_material(const ModelDescription& model) {
  const double alpha = std::clamp(0.5, model.alpha.min, model.alpha.max);
  return grey_material(model, alpha, model.parameter(ParameterRole::kSpecular).range.min, 0.0);
}

}  // namespace

void add_note(std::vector<std::string>& notes, std::string note) {
  if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
}

const ModelDescription* diffuse_model(const std::vector<ModelDescription>& models) {
  const auto found = std::ranges::find_if(models, [](const ModelDescription& model) {
    return model.textures && model.has(ParameterRole::kDiffuse) &&
           model.parameter(ParameterRole::kSpecular).range.min == 0.0;
  });
  return found == models.end() ? nullptr : &*found;
}

std::vector<float> render_external(const Renderer& renderer, const std::vector<ModelDescription>& models,
                                   const TexturedBall& ball, const Scene& scene,
                                   std::vector<std::string>& notes) {
  const ModelDescription& model = *std::ranges::find(models, ball.name, &ModelDescription::name);
  std::vector<Material> materials = {dark_material(model)};
  set_map(
      model, ParameterRole::kRoughness, ball,
      [&](const BallTexel& texel) {
        const double own = from_alpha(model.roughness, texel.alpha);
        return Rgb{own, own, own};
      },
      materials[0], notes);
  set_map(
      model, ParameterRole::kSpecular, ball, [](const BallTexel& texel) { return texel.specular; },
      materials[0], notes);
  if (model.has(ParameterRole::kDiffuse)) {
    set_map(model, ParameterRole::kDiffuse, ball, diffuse_of, materials[0], notes);
  } else if (const ModelDescription* paint = diffuse_model(models); has_diffuse(ball)) {
    if (paint == nullptr)
      throw input_error(model.name + ": has no diffuse, and no other model of this renderer can add it");
    add_note(notes, model.name + " has no diffuse; " + paint->name + " shows the diffuse part");
    materials.push_back(dark_material(*paint));
    set_map(*paint, ParameterRole::kDiffuse, ball, diffuse_of, materials[1], notes);
  }
  const std::vector<std::uint32_t> pixels = shape_pixels(Shape::kSphere, scene.resolution);
  std::vector<float> radiance(3 * pixels.size());
  for (const Material& material : materials) {
    const Image image = renderer.render(material, scene);
    for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] += image.values[3 * pixels[i / 3] + i % 3];
  }
  return radiance;
}

}  // namespace remap
