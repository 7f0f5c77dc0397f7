// This file builds the buffer of a new glTF file, and the views into this buffer. Such a file has only one
// buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/json.hpp"

namespace remap {

// These are targets of buffer views (glTF 2.0, section 5.11).
inline constexpr int kVertexTarget = 34962, kIndexTarget = 34963;

class GltfBuffer {
 public:
  // Appends bytes from a multiple of four. Returns the index of their view.
  std::size_t add_view(std::string bytes, std::optional<int> target = std::nullopt) {
    Json view{{"buffer", 0}, {"byteOffset", padded_size()}, {"byteLength", bytes.size()}};
    if (target) view["target"] = *target;
    views_.push_back(std::move(view));
    size_ = padded_size() + bytes.size();
    parts_.push_back(std::move(bytes));
    return views_.size() - 1;
  }

  std::uint64_t size() const noexcept { return size_; }
  // Returns the size as a multiple of four, as the chunk of a .glb needs.
  std::uint64_t padded_size() const noexcept { return (size_ + 3) / 4 * 4; }
  // Returns the bytes, filled up to `size` with zeros. The buffer frees each part after copying it.
  std::string take(std::uint64_t size) {
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(size));
    for (std::string& part : parts_) {
      bytes.append((4 - bytes.size() % 4) % 4, '\0');
      bytes += std::exchange(part, std::string());
    }
    bytes.resize(static_cast<std::size_t>(size));
    return bytes;
  }
  const Json& views() const noexcept { return views_; }

 private:
  std::vector<std::string> parts_;  // bytes of the views
  std::uint64_t size_ = 0;
  Json views_ = Json::list();
};

}  // namespace remap
