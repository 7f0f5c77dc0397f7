// This file converts MTL texts for tests.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assets/mtl/mtl_asset.hpp"
#include "runtime/assets/gltf_texts.hpp"

namespace remap {

inline AssetConversion converted_mtl(const std::string& text, const AssetResources* resources = nullptr,
                                     const AssetOptions& options = {}) {
  return convert_mtl(MemorySource(text), "file.mtl", options, resources);
}

// Returns the lines of a text, without their endings.
inline std::vector<std::string> lines_in(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    lines.emplace_back(text.substr(at, end - at));
    at = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
  }
  return lines;
}

// Returns the value in a line of a converted text, such as `0.5` in `Pr 0.5`, or an empty text if there is
// none.
inline std::string value_of(const AssetConversion& conversion, const std::string& word) {
  std::string value;
  for (const std::string& line : lines_in(conversion.text))
    if (line.starts_with(word + " ")) value = line.substr(word.size() + 1);
  return value;
}

// Returns a map with one row of `width` texels. A texel is one number or three, from 0 to 255.
inline std::string map_bytes(const std::vector<std::vector<int>>& texels, std::size_t height = 1) {
  ImagePixels pixels{texels.size(), height, texels.front().size(), PixelType::kUint8, {}};
  for (std::size_t y = 0; y < height; ++y)
    for (const std::vector<int>& texel : texels)
      for (const int value : texel) pixels.bytes.push_back(static_cast<std::byte>(value));
  return PlainCodec().encode_png(pixels, kUsualPngLevel);
}

}  // namespace remap
