#include "look/material_looks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "convert/transfer.hpp"
#include "core/errors.hpp"
#include "look/brdf.hpp"
#include "look/image.hpp"
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

namespace {

constexpr double kLeastAlpha = 0.01;  // a smoother ball shows the light's own pixels

// A ScaledChannel receives the means of one channel of a parameter.
struct ScaledChannel {
  const SetParameter& parameter;
  std::size_t channel;
  std::vector<float>& means;
};

// Reads a map once, and averages its channels.
void read_means(ImageReader& map, const std::vector<ScaledChannel>& channels, const ScaledMaps& scaled) {
  const ImageLayout& layout = map.layout();
  const int across = layout.width / scaled.width, down = layout.height / scaled.height;
  std::vector<std::byte> band(layout.row_bytes() * static_cast<std::size_t>(down));
  for (int row = 0; row < scaled.height; ++row) {
    map.read_rows(row * down, down, band.data());
    for (const auto& [parameter, channel, means] : channels)
      scaled.add_means(channel_view(band.data(), layout, parameter.channels[channel].channel), parameter,
                       channel, across, down, row, means);
  }
}

// Fills the rows of a parameter from a map of `width` * `height` texels, or from constants.
void add_rows(const SourceParameter& source, Parameter parameter, int width, int height, ScaledMaps& scaled) {
  const int across = width / scaled.width, down = height / scaled.height;
  auto& rows = scaled.rows[parameter];
  rows.assign(is_color(parameter) ? 3 : 1, std::vector<float>(scaled.count()));
  for (std::size_t c = 0; c < rows.size(); ++c) {
    if (source.channels.empty()) {
      const std::size_t own = std::min(c, source.constants.size() - 1);
      std::ranges::fill(rows[c], source.constants[own] * source.factor(own));
      continue;
    }
    const std::size_t own = std::min(c, source.channels.size() - 1);
    ConstChannelView band = source.channels[own];
    for (int row = 0; row < scaled.height; ++row, band.first += down * band.row_stride)
      scaled.add_means(band, source, own, across, down, row, rows[c]);
  }
}

}  // namespace

ScaledMaps ScaledMaps::cells_of(int full_width, int full_height, int side) {
  const int step = std::max(1, std::max(full_width, full_height) / side);
  return {std::max(1, full_width / step),
          std::max(1, full_height / step),
          RoughnessEncoding::kRoughness,
          {},
          full_width,
          full_height};
}

void ScaledMaps::add_means(const ConstChannelView& band, const ParameterValues& values, std::size_t channel,
                           int across, int down, int row, std::vector<float>& means) const {
  const float share = values.factor(channel) / static_cast<float>(across * down);
  std::vector<float> line(static_cast<std::size_t>(width * across));
  for (std::size_t inner = 0; inner < static_cast<std::size_t>(down); ++inner) {
    load_linear(values.transfer, band.type, at(band, 0, inner), static_cast<std::size_t>(band.texel_stride),
                line.size(), line.data());
    for (int column = 0; column < width * across; ++column)
      means[static_cast<std::size_t>(row * width + column / across)] +=
          share * line[static_cast<std::size_t>(column)];
  }
}

ScaledMaps scaled_maps(TextureSet& set, RoughnessEncoding encoding, int side) {
  const ImageLayout& layout = set.maps[set.first_map()].layout();
  ScaledMaps scaled = ScaledMaps::cells_of(layout.width, layout.height, side);
  scaled.encoding = set.convention.value_or(encoding);
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
  for (const auto& [map, channels] : of_maps) read_means(set.maps[map], channels, scaled);
  return scaled;
}

ScaledMaps scaled_maps(const std::map<Parameter, SourceParameter>& sources, std::size_t width,
                       std::size_t height, RoughnessEncoding encoding, int side) {
  const auto columns = static_cast<int>(width), rows = static_cast<int>(height);
  ScaledMaps scaled = ScaledMaps::cells_of(columns, rows, side);
  scaled.encoding = encoding;
  for (const auto& [parameter, source] : sources) add_rows(source, parameter, columns, rows, scaled);
  return scaled;
}

ScaledMaps converted(const Converter& converter, ScaledMaps maps, double* outside) {
  change_convention(maps.encoding, converter.info().source.roughness,
                    maps.rows.at(Parameter::kRoughness).front());
  MaterialRows<const float> in;
  MaterialRows<float> out;
  ScaledMaps result{maps.width, maps.height,     converter.info().target.roughness,
                    {},         maps.full_width, maps.full_height};
  for (const Parameter parameter : converter.sources()) {
    auto& rows = maps.rows.at(parameter);
    in[parameter].count = rows.size();
    for (std::size_t c = 0; c < rows.size(); ++c) in[parameter].row[c] = rows[c].data();
  }
  for (const Parameter parameter : converter.targets()) {
    if (is_measure(parameter)) continue;
    auto& rows = result.rows[parameter];
    rows.assign(converter.target_channels(parameter, 3), std::vector<float>(maps.count()));
    out[parameter].count = rows.size();
    for (std::size_t c = 0; c < rows.size(); ++c) out[parameter].row[c] = rows[c].data();
  }
  const std::size_t count = converter.convert(maps.count(), in, out);
  if (outside != nullptr) *outside = static_cast<double>(count) / static_cast<double>(maps.count());
  return result;
}

Image normals_of(const std::vector<std::vector<float>>& stored, int width, double scale, NormalGreen green) {
  const bool has_sign = std::ranges::any_of(stored, [](const auto& row) {
    return std::ranges::any_of(row, [](float value) { return value < 0.0f; });
  });
  const std::size_t count = stored.front().size();
  Image normals{width, static_cast<int>(count / static_cast<std::size_t>(width)), 3, {}};
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, 3> normal{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = static_cast<double>(stored[c][i]);
      normal[c] = (has_sign ? value : 2.0 * value - 1.0) * (c < 2 ? scale : 1.0);
    }
    if (green == NormalGreen::kDown) normal[1] = -normal[1];
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (const double value : normal)
      normals.values.push_back(static_cast<float>(length > 0.0 ? value / length : 0.0));
  }
  return normals;
}

Image read_normals(const std::filesystem::path& file, NormalGreen green, int side) {
  TextureSetRequest request;  // the stored values count as a linear color
  request.parameters[Parameter::kDiffuse] = {MapName{file, {}}, {}, Transfer::kLinear};
  TextureSet set = open_texture_set(request);
  if (set.parameters.at(Parameter::kDiffuse).channels.size() < 3) return {};
  const ScaledMaps stored = scaled_maps(set, RoughnessEncoding::kRoughness, side);
  return normals_of(stored.rows.at(Parameter::kDiffuse), stored.width, 1.0, green);
}

TexturedBall ball_of(const std::string& model, ScaledMaps maps) {
  auto& alphas = maps.rows.at(Parameter::kRoughness).front();
  change_convention(maps.encoding, RoughnessEncoding::kAlpha, alphas);
  const auto& specular = maps.rows.at(Parameter::kSpecular);
  const auto& diffuse = maps.rows[Parameter::kDiffuse];
  TexturedBall ball{is_linear_lobe(model) ? builtin_brdf(model) : BrdfModel(), maps.width, maps.height,
                    std::vector<BallTexel>(maps.count()), model};
  for (std::size_t i = 0; i < ball.texels.size(); ++i) {
    BallTexel& texel = ball.texels[i];
    texel.alpha = std::max(static_cast<double>(alphas[i]), kLeastAlpha);
    for (std::size_t c = 0; c < 3; ++c) {
      texel.specular[c] = static_cast<double>(specular[c][i]);
      if (!diffuse.empty()) texel.diffuse[c] = static_cast<double>(diffuse[c][i]);
    }
  }
  return ball;
}

}  // namespace remap
