// Converts a texture set in bands of rows that are read, converted and written, so that memory stays bounded
// for maps of any size.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "remap/convert_maps.hpp"
#include "remap/converter.hpp"
#include "texture/image_io.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// The content of a channel of a result.
struct TargetChannel {
  enum class Content { kParameter, kCopy, kConstant, kMask };
  Content content = Content::kCopy;
  Parameter parameter = Parameter::kWidth;  // for kParameter
  std::size_t index = 0;                    // channel of the parameter
  ChannelPlace from;                        // for kCopy
  float value = 0.0f;                       // for kConstant

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

// Whether a converter makes the channel, that is, it is neither a copy nor a constant.
bool is_converted(const TargetChannel& channel) noexcept;

// One part of a result.
struct TargetPart {
  std::vector<TargetChannel> channels;          // all channels of the part
  Transfer color_transfer = Transfer::kLinear;  // of the converted colors
};

// One result file.
struct TargetMap {
  ImageWriter writer;
  std::vector<TargetPart> parts;
};

struct PassOptions {
  int thread_count = 1;  // of the conversion; with more than 1, reading and writing overlap with it
  // Largest size of a band of the set, unless whole tiles need more. Two bands are in memory, or three if
  // pixel types change.
  std::size_t band_bytes = std::size_t{8} << 20;
  std::optional<RoughnessConvention> target_convention;  // of the results; by default that of the model
  BadTexels bad_texels = BadTexels::kKeep;
  bool dither = false;
  bool value_statistics = false;     // ranges and histograms
  bool metallic_statistics = false;  // reliability of metallic
  // Undetermined metallic follows the metallic around it as far as that has no visible effect. Maps are read
  // twice. The converter must be able to diagnose.
  bool smooth_metallic = false;
  std::function<void(double share_done)> progress;
  const std::atomic<bool>* cancelled = nullptr;  // checked between bands
};

// Converts `set` into `targets` and gives the finished files their names. Each mip level is converted by
// itself, so that a renderer filters the same parameters as in the source. The values equal
// Converter::convert for each texel, rounded to the pixel type of the file, for any thread count and
// band size. Throws the errors of the files and of convert_maps, and kInterrupted if cancelled. After an
// exception no file has appeared, except that after a failed rename the files renamed before it remain.
MapStatistics run_texture_pass(TextureSet& set, std::vector<TargetMap>& targets, const Converter& converter,
                               const PassOptions& options);

}  // namespace remap
