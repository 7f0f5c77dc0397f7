// The pass over a texture set: bands of rows are read, converted and written, so that memory stays bounded
// whatever the size of the maps.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "convert/material_converter.hpp"
#include "texture/convert_maps.hpp"
#include "texture/image_io.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// What a channel of a result holds.
struct TargetChannel {
  enum class Content { kParameter, kCopy, kConstant, kMask };
  Content content = Content::kCopy;
  Parameter parameter = Parameter::kWidth;  // that the converter makes
  std::size_t index = 0;                    // of its channel
  ChannelPlace from;                        // of a copy
  float value = 0.0f;                       // of a constant

  static TargetChannel of(Parameter made, std::size_t channel = 0) {
    TargetChannel target;
    target.content = Content::kParameter;
    target.parameter = made;
    target.index = channel;
    return target;
  }
  static TargetChannel copy(ChannelPlace place) {
    TargetChannel target;
    target.from = place;
    return target;
  }
  static TargetChannel constant(float stored) {
    TargetChannel target;
    target.content = Content::kConstant;
    target.value = stored;
    return target;
  }
  static TargetChannel mask() {
    TargetChannel target;
    target.content = Content::kMask;
    return target;
  }
};

// Whether a converter makes it, rather than a copy or a constant.
bool is_converted(const TargetChannel& channel) noexcept;

// One part of a file that a pass makes.
struct TargetPart {
  std::vector<TargetChannel> channels;          // as many as the part has
  Transfer color_transfer = Transfer::kLinear;  // of the colors that the converter makes
};

// One file that a pass makes.
struct TargetMap {
  ImageWriter writer;
  std::vector<TargetPart> parts;
};

struct PassOptions {
  int thread_count = 1;  // of the conversion; more than 1 also reads ahead and writes behind
  // Bytes that one band of the set may take; whole tiles come first. Two such bands are in memory, three
  // where pixel types change.
  std::size_t band_bytes = std::size_t{8} << 20;
  std::optional<RoughnessConvention> target_convention;  // of the results; none: the model's own
  BadTexels bad_texels = BadTexels::kKeep;
  bool dither = false;
  bool value_statistics = false;     // ranges and histograms
  bool metallic_statistics = false;  // how far metallic can be trusted
  // Where metallic is a guess on which the picture does not depend, it follows the metallic around it, as far
  // as no picture shows that. Maps are read twice. For converters that can diagnose.
  bool smooth_metallic = false;
  std::function<void(double share_done)> progress;
  const std::atomic<bool>* cancelled = nullptr;  // looked at between bands
};

// Converts `set` into `targets`, level by level where they are mip-mapped: a renderer that filters parameters
// sees at every level what it saw of the source. Finishes the files and gives them their names. The values
// equal MaterialConverter::convert applied texel by texel, whatever the thread count and the band size,
// rounded to the pixel type of the file. Throws what the files and convert_maps throw; kInterrupted when
// cancelled. After an exception no file has appeared (after a failing rename, those renamed before it have).
MapStatistics run_texture_pass(TextureSet& set, std::vector<TargetMap>& targets,
                               const MaterialConverter& converter, const PassOptions& options);
// Of width and specular alone.
MapStatistics run_texture_pass(TextureSet& set, std::vector<TargetMap>& targets, const Converter& converter,
                               const PassOptions& options);

}  // namespace remap
