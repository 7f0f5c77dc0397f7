#include "texture/material_survey.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "remap/convert_maps.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

constexpr int kBands = 16, kTexelsARow = 256;
constexpr std::size_t kEstimatedTexels = 2048;

using StoredRows = std::map<std::size_t, std::vector<std::byte>>;

// Returns every `step`-th value of a channel.
std::vector<float> values_of(const TextureSet& set, const StoredRows& rows, const ChannelPlace& place,
                             int step) {
  const ImageLayout& layout = set.maps[place.map].layout();
  std::vector<float> values(static_cast<std::size_t>((layout.width + step - 1) / step));
  ConstChannelView view = channel_view(rows.at(place.map).data(), layout, place.channel);
  view.texel_stride *= step;
  load(view, {0, 0, values.size()}, values.data());
  return values;
}

void add_row(const TextureSet& set, const StoredRows& rows, int step, MaterialSample& sample) {
  std::vector<float> coverage;
  if (set.coverage) coverage = values_of(set, rows, *set.coverage, step);
  for (const auto& [parameter, values] : set.parameters) {
    const std::size_t count = is_color(parameter) ? values.channel_count() : 1;
    auto& own = sample[parameter];
    own.resize(count);
    for (std::size_t c = 0; c < count; ++c) {
      const ImageLayout& layout = set.maps[set.first_map()].layout();
      const auto texels = static_cast<std::size_t>((layout.width + step - 1) / step);
      std::vector<float> row(texels, values.is_map() ? 0.0f : values.constants[c]);
      if (values.is_map()) row = values_of(set, rows, values.channels[c], step);
      if (values.is_map()) to_linear(values.transfer, row);
      const float factor = values.factor(c);
      for (std::size_t i = 0; i < row.size(); ++i)
        if (coverage.empty() || coverage[i] > 0.0f) own[c].push_back(row[i] * factor);
    }
  }
}

}  // namespace

MaterialSample sample_materials(TextureSet& set) {
  MaterialSample sample;
  const std::set<std::size_t> maps = set.maps_of_material();
  const ImageLayout& first = set.maps[set.first_map()].layout();
  const int height = first.height, step = std::max(1, first.width / kTexelsARow);
  int unit = 1;
  for (const std::size_t map : maps)
    if (const int tile = set.maps[map].layout().tile_height; tile > 0) unit = std::lcm(unit, tile);
  const int units = (height + unit - 1) / unit, bands = std::min(kBands, units);
  for (int band = 0; band < bands; ++band) {
    const int begin = static_cast<int>((2 * band + 1) * static_cast<long long>(units) / (2 * bands)) * unit;
    const int count = std::min(unit, height - begin);
    StoredRows rows;
    for (const std::size_t map : maps) {
      rows[map].resize(static_cast<std::size_t>(count) * set.maps[map].layout().row_bytes());
      set.maps[map].read_rows(begin, count, rows[map].data());
    }
    add_row(set, rows, step, sample);
  }
  return sample;
}

std::optional<DielectricF0> estimated_f0(const MaterialSample& sample, const WorkflowStages& stages,
                                         RoughnessEncoding width) {
  const std::size_t texels = sample.at(Parameter::kRoughness).front().size();
  if (texels == 0) return std::nullopt;
  const SpecularWorkflow plain;
  WorkflowStages to_plain = stages;
  to_plain.target = plain;
  const auto converter = make_workflow_converter(to_plain, InstructionSet::kBaseline);
  const std::size_t every = std::max<std::size_t>(1, texels / kEstimatedTexels);
  std::vector<SpecularMaterial> materials((texels + every - 1) / every);
  MapConversion maps;
  maps.width = materials.size();
  maps.height = 1;
  maps.source_convention = width;
  maps.target_convention = RoughnessEncoding::kAlpha;
  for (const Parameter parameter : converter->sources())
    for (const std::vector<float>& row : sample.at(parameter))
      maps.sources[parameter].channels.push_back(float_channel(row.data(), maps.width, every));
  const auto add_target = [&](Parameter parameter, float& first) {
    constexpr std::size_t kFloats = sizeof(SpecularMaterial) / sizeof(float);
    maps.targets[parameter].channels.push_back(float_channel(&first, maps.width, kFloats));
  };
  for (std::size_t c = 0; c < 3; ++c) {
    add_target(Parameter::kDiffuse, materials.front().diffuse[c]);
    add_target(Parameter::kSpecular, materials.front().specular[c]);
  }
  add_target(Parameter::kRoughness, materials.front().width);
  convert_maps(*converter, maps);
  SpecularWorkflow specular = plain;
  specular.width = RoughnessEncoding::kAlpha;
  try {
    return estimate_dielectric_f0(specular, std::get<MetallicWorkflow>(stages.target), materials);
  } catch (const Error&) {
    return std::nullopt;  // all texels are NaN
  }
}

}  // namespace remap
