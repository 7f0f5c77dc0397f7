#include "report/set_preview.hpp"

#include <algorithm>
#include <atomic>
#include <map>

#include "convert/linear_values.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "lights/lit_sphere.hpp"
#include "remap/path.hpp"
#include "renderer/image_similarity.hpp"
#include "renderer/scene.hpp"
#include "report/contact_sheet.hpp"
#include "sets/folder_walk.hpp"

namespace remap {
namespace {

// A ScaledSet holds the linear values of each parameter in rows of width * height texels.
struct ScaledSet {
  int width = 0, height = 0;
  std::map<Parameter, std::vector<std::vector<float>>> rows;

  std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

// A ScaledChannel receives the means of one channel of a parameter.
struct ScaledChannel {
  const SetParameter& parameter;
  std::size_t channel;
  std::vector<float>& means;
};

// Reads a map once, and averages its channels over cells of whole texels.
void add_means(ImageReader& map, const std::vector<ScaledChannel>& channels, const ScaledSet& size) {
  const ImageLayout& layout = map.layout();
  const int across = layout.width / size.width, down = layout.height / size.height;
  std::vector<std::byte> band(layout.row_bytes() * static_cast<std::size_t>(down));
  std::vector<float> line(static_cast<std::size_t>(layout.width));
  for (int row = 0; row < size.height; ++row) {
    map.read_rows(row * down, down, band.data());
    for (const auto& [parameter, channel, means] : channels) {
      const float share = parameter.factor(channel) / static_cast<float>(across * down);
      const auto view = channel_view(band.data(), layout, parameter.channels[channel].channel);
      for (std::size_t inner = 0; inner < static_cast<std::size_t>(down); ++inner) {
        load_linear(parameter.transfer, view.type, at(view, 0, inner),
                    static_cast<std::size_t>(view.texel_stride), line.size(), line.data());
        for (int column = 0; column < size.width * across; ++column)
          means[static_cast<std::size_t>(row * size.width + column / across)] +=
              share * line[static_cast<std::size_t>(column)];
      }
    }
  }
}

ScaledSet scaled_set(TextureSet& set, int side) {
  const ImageLayout& layout = set.maps[set.first_map()].layout();
  const int step = std::max(1, std::max(layout.width, layout.height) / side);
  ScaledSet scaled{std::max(1, layout.width / step), std::max(1, layout.height / step), {}};
  std::map<std::size_t, std::vector<ScaledChannel>> of_maps;
  for (const auto& [parameter, values] : set.parameters) {
    const std::size_t channels = is_color(parameter) ? 3 : 1;
    auto& rows = scaled.rows[parameter];
    rows.assign(channels, std::vector<float>(scaled.count()));
    for (std::size_t c = 0; c < channels; ++c) {
      const std::size_t own = std::min(c, values.channel_count() - 1);
      if (values.is_map())
        of_maps[values.channels[own].map].push_back({values, own, rows[c]});
      else
        std::ranges::fill(rows[c], values.constants[own] * values.factor(own));
    }
  }
  for (const auto& [map, channels] : of_maps) add_means(set.maps[map], channels, scaled);
  return scaled;
}

// Converts all texels. `width` is the encoding of the roughness in `set`. The result has the encoding of the
// converter.
ScaledSet converted(const Converter& converter, ScaledSet set, RoughnessEncoding width) {
  change_convention(width, converter.info().source.roughness, set.rows.at(Parameter::kRoughness).front());
  MaterialRows<const float> in;
  MaterialRows<float> out;
  ScaledSet result{set.width, set.height, {}};
  for (const Parameter parameter : converter.sources()) {
    auto& rows = set.rows.at(parameter);
    in[parameter].count = rows.size();
    for (std::size_t c = 0; c < rows.size(); ++c) in[parameter].row[c] = rows[c].data();
  }
  for (const Parameter parameter : converter.targets()) {
    if (is_measure(parameter)) continue;
    auto& rows = result.rows[parameter];
    rows.assign(converter.target_channels(parameter, 3), std::vector<float>(set.count()));
    out[parameter].count = rows.size();
    for (std::size_t c = 0; c < rows.size(); ++c) out[parameter].row[c] = rows[c].data();
  }
  converter.convert(set.count(), in, out);
  return result;
}

// A ShownModel is a BRDF model as the built-in renderer shows it.
class ShownModel {
 public:
  ShownModel(const std::string& model, const ConverterGraph& graph) : model_(model) {
    if (is_linear_lobe(model)) return;
    std::vector<ConverterPath> paths;
    for (const std::string& other : graph.reachable_from(model))
      if (is_linear_lobe(other)) paths.push_back(graph.find_paths({model, other, {}}).front());
    if (paths.empty())
      throw input_error(model + ": no built-in model is close to it, so that it cannot be shown");
    const ConverterPath& closest = closest_path(paths);
    to_shown_ = make_chained_converter(closest.steps);
    model_ = target_model(closest);
  }

  const std::string& name() const { return model_; }

  // Returns the ball of a material with specular, diffuse and a width of `encoding`.
  TexturedBall ball(ScaledSet set, RoughnessEncoding encoding) const {
    if (to_shown_ != nullptr) {
      std::vector<std::vector<float>> diffuse = std::move(set.rows[Parameter::kDiffuse]);
      set = converted(*to_shown_, std::move(set), encoding);
      set.rows[Parameter::kDiffuse] = std::move(diffuse);
      encoding = to_shown_->info().target.roughness;
    }
    auto& width = set.rows.at(Parameter::kRoughness).front();
    change_convention(encoding, RoughnessEncoding::kAlpha, width);
    TexturedBall ball{builtin_brdf(model_), set.width, set.height, std::vector<BallTexel>(set.count())};
    for (std::size_t i = 0; i < ball.texels.size(); ++i) {
      BallTexel& texel = ball.texels[i];
      texel.alpha = std::max(static_cast<double>(width[i]), kLeastAlpha);
      for (std::size_t c = 0; c < 3; ++c) {
        texel.specular[c] = static_cast<double>(set.rows.at(Parameter::kSpecular)[c][i]);
        if (const auto& diffuse = set.rows[Parameter::kDiffuse]; !diffuse.empty())
          texel.diffuse[c] = static_cast<double>(diffuse[c][i]);
      }
    }
    return ball;
  }

 private:
  static constexpr double kLeastAlpha = 0.01;  // a smoother ball would show the pixels of the light
  std::string model_;
  std::unique_ptr<Converter> to_shown_;  // null if the model itself is shown
};

// A SetSide is one end of the conversion.
struct SetSide {
  std::optional<WorkflowEnd> workflow;
  ShownModel model;

  // Returns the ball of the numbers in `set`, whose width has this encoding.
  TexturedBall ball(const ScaledSet& set, RoughnessEncoding width) const {
    if (!workflow) return model.ball(set, width);
    const SpecularWorkflow plain{"specular", DiffuseConvention::kPlain, RoughnessEncoding::kAlpha};
    const WorkflowStages stages{*workflow, plain, nullptr, RoughnessEncoding::kAlpha};
    return model.ball(converted(*make_workflow_converter(stages), set, width), RoughnessEncoding::kAlpha);
  }
};

class SetSheet {
 public:
  SetSheet(const ConvertPlan& plan, const SetPreviewOptions& options)
      : chosen_(plan.sets()->chosen),
        options_(options),
        graph_(shipped_graph()),
        source_{chosen_.workflow.source, ShownModel(chosen_.workflow.source_brdf, graph_)},
        target_{chosen_.workflow.target, ShownModel(chosen_.workflow.target_brdf, graph_)},
        light_(std::span(&options.light, 1), kLightRows),
        pixels_(shape_pixels(Shape::kSphere, options.resolution)) {
    const ConverterInfo& info = chosen_.info();
    const std::string& target = options.target.empty() ? info.target.model : options.target;
    preview_.labels.columns = {"source\n" + (options.source.empty() ? info.source.model : options.source)};
    if (can_copy()) preview_.labels.columns.push_back("numbers copied\n" + target);
    preview_.labels.columns.push_back("converted\n" + target);
    note(chosen_.workflow.source_brdf, source_.model);
    note(chosen_.workflow.target_brdf, target_.model);
    if (chosen_.workflow.translation)
      preview_.notes.push_back("layers over the base, such as coats and sheen, are not shown");
    for (const Job& job : plan.list.jobs)
      if (jobs_.size() < options.most_sets) jobs_.push_back(&job);
    preview_.sheet =
        contact_sheet(jobs_.size(), preview_.labels.columns.size(), cell_side(options.resolution));
  }

  SetPreview filled() {
    for (std::size_t row = 0; row < jobs_.size(); ++row) add_row(row);
    return std::move(preview_);
  }

 private:
  static constexpr int kLightRows = 64;  // each spot of light costs as much as a sample

  bool can_copy() const {
    return source_.workflow.has_value() == target_.workflow.has_value() &&
           (!source_.workflow || kind_of(*source_.workflow) == kind_of(*target_.workflow));
  }
  void note(const std::string& model, const ShownModel& shown) {
    const std::string text = model + " is shown as " + shown.name() + ", the closest built-in model";
    if (model != shown.name() && std::ranges::find(preview_.notes, text) == preview_.notes.end())
      preview_.notes.push_back(text);
  }
  void add_row(std::size_t row) {
    const Job& job = *jobs_[row];
    TextureSet set = open_texture_set(std::get<SetWork>(job.work).request);
    const ConverterInfo& info = chosen_.info();
    const RoughnessEncoding width = set.convention.value_or(info.source.roughness);
    const ScaledSet given = scaled_set(set, options_.resolution);
    std::vector<TexturedBall> balls = {source_.ball(given, width)};
    if (can_copy()) balls.push_back(target_.ball(given, width));
    balls.push_back(target_.ball(converted(chosen_.converter(), given, width), info.target.roughness));
    show(row, job, balls);
  }

  void show(std::size_t row, const Job& job, const std::vector<TexturedBall>& balls) {
    std::atomic<int> lines = 0;
    SphereSampling sampling;
    sampling.resolution = options_.resolution;
    sampling.samples = options_.directions;
    sampling.progress = [&] {
      const double share = static_cast<double>(++lines) / options_.resolution;
      if (options_.progress)
        options_.progress((static_cast<double>(row) + share) / static_cast<double>(jobs_.size()));
    };
    std::vector<DisplayedSphere> shown;
    for (const auto& picture : render_textured(light_, balls, sampling))
      shown.push_back(displayed_sphere(picture, pixels_, options_.resolution));
    const std::vector<std::uint32_t> places = pixels_of_cell(pixels_, options_.resolution);
    for (std::size_t column = 0; column < shown.size(); ++column)
      place_picture(&preview_.sheet, cell_side(options_.resolution), row, column, places,
                    shown[column].colors);
    const auto similarity = [&](const DisplayedSphere& other) {
      return preview_similarity(shown[0], other, pixels_, options_.resolution);
    };
    SetFigure figure{job.name.empty() ? "maps" : display_path(std::filesystem::path(job.name).filename()),
                     std::nullopt, similarity(shown.back())};
    if (can_copy()) figure.copied = similarity(shown[1]);
    const auto text = [](const std::string& name, const PreviewSimilarity& of) {
      return "\n" + name + ":\nerror " + fixed(100.0 * of.rms, 1) + " %\nSSIM " + fixed(of.ssim, 3);
    };
    preview_.labels.rows.push_back(figure.name + (figure.copied ? text("copied", *figure.copied) : "") +
                                   text("converted", figure.converted));
    preview_.figures.push_back(std::move(figure));
  }

  const ChosenConverter& chosen_;
  const SetPreviewOptions& options_;
  ConverterGraph graph_;
  SetSide source_, target_;
  RadiancePyramid light_;
  std::vector<std::uint32_t> pixels_;
  std::vector<const Job*> jobs_;
  SetPreview preview_;
};

}  // namespace

SetPreview preview_sets(const ConvertPlan& plan, const SetPreviewOptions& options) {
  if (plan.sets() == nullptr)
    throw usage_error("preview: shows texture sets, not assets (export the textures)");
  if (plan.list.jobs.empty()) throw usage_error("preview: no texture set found");
  return SetSheet(plan, options).filled();
}

}  // namespace remap
