// This file describes layouts of images in files, and how a new image may differ from its model.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "remap/pixels.hpp"

namespace remap {

struct Channel {
  std::string name;
  PixelType type = PixelType::kFloat;
  std::size_t offset = 0;  // place in a texel, in bytes
  bool operator==(const Channel&) const = default;
};

// An ImageLayout is the layout of an image's texels in memory and in the file.
struct ImageLayout {
  int width = 0;
  int height = 0;
  int x = 0;  // position of the first texel; in EXR, the corner of the data window
  int y = 0;
  std::vector<Channel> channels;
  std::size_t texel_bytes = 0;              // size of a texel; channels are interleaved without gaps
  int alpha_channel = -1;                   // index, or -1
  int tile_height = 0;                      // 0 for a file that is stored by rows
  std::string format;                       // name in OpenImageIO: "openexr", "tiff", "png", "jpeg", ...
  std::string lossy_compression;            // empty for a lossless file
  bool has_compression_level = false;       // true if the compression has a level
  std::optional<Transfer> tagged_transfer;  // transfer curve of colors, if the file states it

  std::size_t row_bytes() const noexcept { return static_cast<std::size_t>(width) * texel_bytes; }
};

// Returns true if two images have the same number of channels with the same types.
inline bool same_pixel_types(const ImageLayout& a, const ImageLayout& b) noexcept {
  return std::ranges::equal(a.channels, b.channels,
                            [](const Channel& x, const Channel& y) { return x.type == y.type; });
}

// Returns a channel of rows that have this layout.
template <typename Byte>
BasicChannelView<Byte> channel_view(Byte* texels, const ImageLayout& layout, std::size_t channel) {
  return {texels + layout.channels[channel].offset, layout.channels[channel].type,
          static_cast<std::ptrdiff_t>(layout.texel_bytes), static_cast<std::ptrdiff_t>(layout.row_bytes())};
}

using Metadata = std::vector<std::pair<std::string, std::string>>;  // name and text

// A ColorStorage decides how a new image stores its colors, depending on its pixel type.
struct ColorStorage {
  std::optional<Transfer> chosen;    // chosen by the user
  std::optional<Transfer> followed;  // curve of the integer map that the colors are made from

  Transfer of(PixelType type) const {
    const Transfer usual = usual_color_transfer(type);
    return chosen.value_or(is_integer(type) ? followed.value_or(usual) : usual);
  }
};

// An ImageChanges lists how a new image differs from the image that it follows.
struct ImageChanges {
  std::optional<PixelType> type;                     // type of all channels
  std::optional<std::vector<std::string>> channels;  // new names; all have the type of the old channel 0
  std::optional<ColorStorage> colors;                // if unset, all channels are data
  std::optional<int> compression_level;              // 1 (fast) to 9 (small), if the compression has levels
  Metadata metadata;  // tags to add; TIFF and JPEG store them in the tag Software
};

}  // namespace remap
