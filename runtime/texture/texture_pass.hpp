// This file converts a texture set in bands of rows. It reads, converts and writes one band after another, so
// that memory stays bounded for maps of any size.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <variant>
#include <vector>

#include "remap/convert_maps.hpp"
#include "remap/converter.hpp"
#include "texture/image_reader.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// A TargetChannel is the content of a channel of a result. It is a converted value, the mask of texels
// outside of the domain, a copy of a channel of the set, or one stored value for all texels.
struct ConvertedChannel {
  Parameter parameter = Parameter::kRoughness;
  std::size_t index = 0;  // channel of the parameter, such as 2 for blue
};
using MaskChannel = std::monostate;
using TargetChannel = std::variant<ConvertedChannel, MaskChannel, ChannelPlace, float>;

// Returns true if a converter makes the channel. Copies and constants are not converted.
inline bool is_converted(const TargetChannel& channel) noexcept { return channel.index() < 2; }

struct TargetPart {
  std::size_t model = 0;  // index of the map that the part is made from
  ImageChanges changes;
  std::vector<TargetChannel> channels;  // all channels of the part
};

// A TargetMap is one result file.
struct TargetMap {
  std::unique_ptr<NewImage> writer;
  std::vector<TargetPart> parts;
};

struct PassOptions : MapTreatment {
  int thread_count = 1;  // threads of the conversion; above 1, reading and writing overlap
  // This is the largest size of a band, unless whole tiles need more. Two bands are in memory at once, or
  // three if pixel types change.
  std::size_t band_bytes = std::size_t{8} << 20;
  std::function<void(double share_done)> progress = {};
  // Gives the finished files their final names. By default, this calls NewImage::commit() for each file.
  std::function<void(std::vector<TargetMap>& finished)> commit = {};
  const std::atomic<bool>* cancelled = nullptr;  // checked between bands
};

// Converts `set` into `targets` and gives the finished files their final names. Each mip level is converted
// separately, so that a renderer filters the same parameters as in the source. The values equal
// Converter::convert for each texel, rounded to the pixel type of the file, for any thread count and band
// size. Throws the errors of the files and of convert_maps, and kInterrupted if cancelled. After an
// exception, no file has appeared. Only if a rename fails, the files that were renamed before remain.
MapStatistics run_texture_pass(TextureSet& set, std::vector<TargetMap>& targets, const Converter& converter,
                               const PassOptions& options);

}  // namespace remap
