// The one buffer of a glTF file that is made from other files, and its views.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/json.hpp"

namespace remap {

// Targets of buffer views (glTF 2.0, section 5.11).
inline constexpr int kVertexTarget = 34962, kIndexTarget = 34963;

class GltfBuffer {
 public:
  // Appends bytes from a multiple of four. Returns the index of their view.
  std::size_t add_view(std::string_view bytes, std::optional<int> target = std::nullopt) {
    bytes_.append((4 - bytes_.size() % 4) % 4, '\0');
    Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
    if (target) view["target"] = *target;
    views_.push_back(std::move(view));
    bytes_ += bytes;
    return views_.size() - 1;
  }

  const std::string& bytes() const noexcept { return bytes_; }
  std::string& bytes() noexcept { return bytes_; }
  const Json& views() const noexcept { return views_; }

 private:
  std::string bytes_;
  Json views_ = Json::list();
};

}  // namespace remap
