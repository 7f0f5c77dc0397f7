#include "look/gltf_looks.hpp"

#include "assets/gltf/gltf_bytes.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "assets/gltf/gltf_new_images.hpp"
#include "assets/gltf/gltf_workflow.hpp"
#include "assets/gltf/material_textures.hpp"
#include "core/errors.hpp"
#include "core/json_spans.hpp"
#include "look/brdf_models.hpp"

namespace remap {
namespace {

GltfWorkflow workflow_of(SpanValue material) {
  const SpanValue extensions = material["extensions"];
  if (extensions["KHR_materials_pbrSpecularGlossiness"]) return GltfWorkflow::kSpecGloss;
  const bool has_f0 = extensions["KHR_materials_specular"] || extensions["KHR_materials_ior"];
  return has_f0 ? GltfWorkflow::kDielectric : GltfWorkflow::kMetalRough;
}

// Fills the rows of one parameter of `scaled` from a map of `width` * `height` texels.
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

// A GltfReader reads materials as maps of the plain specular workflow.
class GltfReader {
 public:
  explicit GltfReader(const GltfFile& file)
      : container_(read_container(file.bytes, file.context)),
        json_(container_.json, file.context),
        bytes_(json_, container_, file.bytes,
               [&resources = file.resources](const std::string& path) { return resources.open(path); }),
        images_(json_, bytes_, file.resources),
        added_(json_, container_, file.resources, file.context),
        textures_(options_, file.resources, images_, added_) {}

  SpanValue material(std::size_t index) const { return json_.root()["materials"].children().at(index); }

  // Returns the maps of a material in the parameters of the workflow.
  ScaledMaps maps(SpanValue text, GltfWorkflow workflow, int side) {
    std::vector<std::string> ignored;
    GltfMaterial material = read_material(text, workflow, ignored);
    const std::optional<UsedTextures> used =
        used_textures(&textures_, material, inputs_of(workflow), {"the picture", ""}, ignored);
    ScaledMaps maps;
    if (!used) {
      for (const auto& [parameter, values] : values_of(workflow, material))
        for (const float value : values) maps.rows[parameter].push_back({value});
      return maps;
    }
    const GltfMaps read(workflow, material, *used);
    const ImagePixels& model = *read.sources.color_model;
    const auto width = static_cast<int>(model.width), height = static_cast<int>(model.height);
    maps = ScaledMaps::cells_of(width, height, side);
    maps.encoding = *read.sources.conversion.source_convention;
    for (const auto& [parameter, source] : read.sources.conversion.sources)
      add_rows(source, parameter, width, height, maps);
    return maps;
  }

  TexturedBall ball(GltfWorkflow workflow, ScaledMaps maps) const {
    const auto plain = converter_of(workflow, "specular", options_);
    return ball_of(builtin_brdf("mitsuba/ggx"), converted(*plain, std::move(maps)));
  }

 private:
  // Maps of different sizes and transforms are shown as well, although a conversion may refuse them.
  static AssetOptions tolerant() {
    AssetOptions options;
    options.resamples = true;
    return options;
  }

  const AssetOptions options_ = tolerant();
  GltfContainer container_;
  SpannedJson json_;
  GltfBytes bytes_;
  GltfImages images_;
  GltfNewImages added_;
  MaterialTextures textures_;
};

}  // namespace

std::vector<MaterialLooks> gltf_looks(const GltfFile& source, const GltfFile& result,
                                      const std::vector<AssetMaterial>& materials, int side,
                                      std::size_t most) {
  GltfReader before(source), after(result);
  std::vector<MaterialLooks> looks;
  for (const AssetMaterial& material : materials) {
    if (material.state != MaterialState::kConverted || looks.size() == most) continue;
    const SpanValue from = before.material(material.index), to = after.material(material.index);
    const GltfWorkflow workflow = workflow_of(from), new_workflow = workflow_of(to);
    MaterialLooks shown;
    shown.name = material.name.empty() ? "material " + std::to_string(material.index) : material.name;
    shown.before = before.maps(from, workflow, side);
    shown.after = after.maps(to, new_workflow, side);
    shown.source = before.ball(workflow, shown.before);
    shown.converted = after.ball(new_workflow, shown.after);
    if (constexpr auto kCore = GltfWorkflow::kMetalRough; workflow != kCore)
      shown.copied = before.ball(kCore, before.maps(from, kCore, side));
    looks.push_back(std::move(shown));
  }
  return looks;
}

}  // namespace remap
