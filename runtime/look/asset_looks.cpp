#include "look/asset_looks.hpp"

namespace remap {

std::vector<MaterialLooks> asset_looks(AssetReader& source, AssetReader& result, const ShownModel& before,
                                       const ShownModel& after, const std::vector<AssetMaterial>& materials,
                                       int side, std::size_t most) {
  std::vector<MaterialLooks> looks;
  for (const AssetMaterial& material : materials) {
    if (material.state != MaterialState::kConverted || looks.size() == most) continue;
    MaterialLooks shown;
    shown.name = material.name.empty() ? "material " + std::to_string(material.index) : material.name;
    shown.normals = source.normals(material, side);
    shown.before = source.maps(material, side);
    shown.after = result.maps(material, side);
    shown.source = source.ball(material, before, shown.before);
    shown.converted = result.ball(material, after, shown.after);
    shown.copied = source.without_extensions(material, after, side);
    looks.push_back(std::move(shown));
  }
  return looks;
}

}  // namespace remap
