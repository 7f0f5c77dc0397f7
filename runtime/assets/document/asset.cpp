#include "assets/document/asset.hpp"

#include <algorithm>

#include "core/plain_text.hpp"

namespace remap {

std::string AssetMaterial::title() const {
  return "material " + std::to_string(index) + (name.empty() ? "" : " \"" + plain(name, 80) + "\"");
}

std::size_t count_of(const std::vector<AssetMaterial>& materials, MaterialState state) {
  return static_cast<std::size_t>(std::ranges::count(materials, state, &AssetMaterial::state));
}

}  // namespace remap
