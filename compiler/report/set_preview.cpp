#include <algorithm>
#include <atomic>
#include <functional>
#include <iterator>
#include <map>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "look/scene.hpp"
#include "report/contact_sheet.hpp"
#include "report/preview.hpp"
#include "texremap/report/job_looks.hpp"

namespace remap {
namespace {

// Adds a note, unless `notes` has it.
void add_note(std::vector<std::string>& notes, std::string note) {
  if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
}

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

// Returns the first of `models` that shows the diffuse part of materials whose own model has none: it has
// maps, and no highlight at specular 0. Returns null if all models lack this.
const ModelDescription* diffuse_model(const std::vector<ModelDescription>& models) {
  const auto found = std::ranges::find_if(models, [](const ModelDescription& model) {
    return model.textures && model.has(ParameterRole::kDiffuse) &&
           model.parameter(ParameterRole::kSpecular).range.min == 0.0;
  });
  return found == models.end() ? nullptr : &*found;
}

// Renders a ball by its external model, lit by the environment of `scene`. Light bounces once, so a model
// without a diffuse part gets the picture of diffuse_model() added. `models` are all models of its renderer.
// Adds what the picture does not show to `notes`, unless they have it. Returns linear RGB like
// render_textured(). Throws like Renderer.
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

constexpr std::size_t kMostMaterials = 4;  // of a preview

// A BallStudio renders the balls of a preview, each by its own renderer.
class BallStudio {
 public:
  explicit BallStudio(const SetPreviewOptions& options)
      : options_(options), environment_(std::span(&options.light, 1), kPreviewLightRows) {}

  // Returns a test for the models of a worker that can show maps, or of the built-in renderer.
  ModelTest models_of(const std::string& worker, const std::string& option) {
    if (worker.empty()) return is_linear_lobe;
    std::vector<ModelDescription>& models = models_[worker];
    if (models.empty()) models = options_.renderers->models_of(worker);
    if (std::ranges::none_of(models, &ModelDescription::textures))
      throw usage_error(
          option + " " + worker +
          ": this renderer shows no maps (choose one that `remapc renderers` lists with \"textures\")");
    return [&models](const std::string& name) {
      const auto found = std::ranges::find(models, name, &ModelDescription::name);
      return found != models.end() && found->textures;
    };
  }

  // Renders balls, and reports the finished fraction of the rows. Balls of workers have no normal maps, and
  // the balls beside them then have none either.
  std::vector<std::vector<float>> render(std::span<const TexturedBall> balls, const Image& normals,
                                         const std::function<void(double)>& progress) {
    std::vector<TexturedBall> own;
    std::ranges::remove_copy_if(balls, std::back_inserter(own), is_external);
    std::vector<std::vector<float>> shaded =
        own.empty() ? std::vector<std::vector<float>>{}
                    : shade(own, own.size() == balls.size() ? normals : Image(), progress);
    if (own.size() < balls.size() && !normals.values.empty())
      add_note(notes_, "normal maps are not shown, because they are not passed to other renderers");
    std::vector<std::vector<float>> pictures;
    auto next = shaded.begin();
    for (const TexturedBall& ball : balls)
      pictures.push_back(is_external(ball) ? render_by_worker(ball) : std::move(*next++));
    return pictures;
  }

  const std::vector<std::string>& notes() const { return notes_; }

 private:
  // Balls of the built-in renderer share their light directions.
  std::vector<std::vector<float>> shade(std::span<const TexturedBall> balls, const Image& normals,
                                        const std::function<void(double)>& progress) const {
    std::atomic<int> rows = 0;
    SphereSampling sampling;
    sampling.resolution = options_.resolution;
    sampling.samples = options_.directions;
    sampling.progress = [&] { progress(static_cast<double>(++rows) / options_.resolution); };
    return render_textured(environment_, balls, normals, sampling);
  }

  std::vector<float> render_by_worker(const TexturedBall& ball) {
    Scene scene;
    scene.resolution = options_.resolution;
    scene.samples_per_axis = 1;
    scene.environment = &options_.light.map;
    scene.light_samples = options_.external_directions;
    return render_external(*options_.renderers, models_.at(renderer_of(ball.name)), ball, scene, notes_);
  }

  const SetPreviewOptions& options_;
  const RadiancePyramid environment_;
  std::map<std::string, std::vector<ModelDescription>> models_;  // of the workers in use
  std::vector<std::string> notes_;
};

std::string figure_text(const SetFigure& figure) {
  const auto text = [](const std::string& name, const PictureError& of) {
    return "\n" + name + ":\nerror " + fixed(100.0 * of.rms, 1) + " %\nSSIM " + fixed(of.ssim, 3);
  };
  return figure.name + (figure.copied ? text("copied", *figure.copied) : "") +
         text("converted", figure.converted);
}

// Reads the first materials of all jobs.
std::vector<MaterialLooks> first_looks(const ConvertPlan& plan, const JobLooks& looks,
                                       const SetPreviewOptions& options) {
  std::vector<MaterialLooks> shown;
  for (const Job& job : plan.list.jobs)
    for (MaterialLooks& material : looks.of(job, options.resolution, kMostMaterials - shown.size()))
      shown.push_back(std::move(material));
  return shown;
}

}  // namespace

SetPreview preview_sets(const ConvertPlan& plan, const SetPreviewOptions& options) {
  if (plan.list.jobs.empty())
    throw usage_error("preview: no texture set and no asset found (check the path, or add --recursive)");
  BallStudio studio(options);
  const JobLooks looks(plan, studio.models_of(options.renderer_before, "--renderer-before"),
                       studio.models_of(options.renderer_after, "--renderer-after"));
  const std::vector<MaterialLooks> shown = first_looks(plan, looks, options);
  if (shown.empty()) throw usage_error("preview: the conversion changes no material");
  const bool has_copies =
      std::ranges::any_of(shown, [](const auto& look) { return look.copied.has_value(); });
  SetPreview preview;
  preview.copied_title = looks.copied_title();
  preview.labels.columns = {"source\n" + options.source};
  if (has_copies) preview.labels.columns.push_back(preview.copied_title + "\n" + options.target);
  preview.labels.columns.push_back("converted\n" + options.target);
  preview.sheet = contact_sheet(shown.size(), preview.labels.columns.size(), cell_side(options.resolution));
  const std::vector<std::uint32_t> places =
      pixels_of_cell(shape_pixels(Shape::kSphere, options.resolution), options.resolution);
  for (std::size_t row = 0; row < shown.size(); ++row) {
    const auto progress = [&](double share) {
      if (options.progress)
        options.progress((static_cast<double>(row) + share) / static_cast<double>(shown.size()));
    };
    const LitLooks pictures = light(
        shown[row],
        [&](std::span<const TexturedBall> balls, const Image& normals) {
          return studio.render(balls, normals, progress);
        },
        options.resolution);
    for (std::size_t i = 0; i < pictures.pictures.size(); ++i) {
      const bool is_last = i + 1 == pictures.pictures.size();
      place_picture(&preview.sheet, cell_side(options.resolution), row,
                    is_last ? preview.labels.columns.size() - 1 : i, places, pictures.pictures[i].colors);
    }
    preview.figures.push_back({shown[row].name, pictures.copied, pictures.converted, shown[row].outside});
    preview.labels.rows.push_back(figure_text(preview.figures.back()));
  }
  preview.notes = looks.notes();
  preview.notes.insert(preview.notes.end(), studio.notes().begin(), studio.notes().end());
  return preview;
}

}  // namespace remap
