// What only converted materials used: textures, images and views whose places new ones can take, and the end
// of the bytes that are still used. No index changes: extras and other programs may name them.
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
  std::vector<std::size_t> textures, images, views;  // sorted indices; views of the binary chunk
  std::optional<std::uint64_t> chunk_end;            // of what is still used; none: nothing is cut
};

// Finds the textures, images and views that nothing uses after the edits. If the file uses extensions that
// are unknown, or that name images themselves, it finds nothing and adds a warning.
GltfSpares find_spares(const SpannedJson& json, const GltfContainer& container,
                       const std::vector<MaterialEdit>& edits, std::vector<std::string>& warnings);

}  // namespace remap
