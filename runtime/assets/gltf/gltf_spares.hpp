// This file finds textures, images and views that only converted materials used, so that new ones can replace
// them. It also finds the end of the bytes that are still in use. Indices do not change, because extras and
// other programs may use them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/gltf/gltf_container.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "core/json_spans.hpp"

namespace remap {

struct GltfSpares {
  std::vector<std::size_t> textures, images, views;  // sorted indices; the views are in the binary chunk
  std::optional<std::uint64_t> chunk_end;            // end of the used bytes; if unset, nothing is cut off
};

// Finds the textures, images and views that nothing uses after the edits. If the file uses extensions that
// are unknown, or that name images themselves, it finds nothing and adds a warning.
GltfSpares find_spares(const SpannedJson& json, const GltfContainer& container,
                       const std::vector<MaterialEdit>& edits, std::vector<std::string>& warnings);

}  // namespace remap
