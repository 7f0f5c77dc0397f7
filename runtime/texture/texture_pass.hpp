// The pass over a texture set: bands of rows are read, converted and written, so that memory stays bounded
// whatever the size of the maps.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

#include "convert/converter.hpp"
#include "texture/image_io.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// The maps that a pass makes.
struct TargetMaps {
  ImageWriter roughness;
  ImageWriter specular;
};

// What was met on the way. Texels count once in each line that applies to them.
struct PassStatistics {
  std::size_t texel_count = 0;
  std::size_t out_of_domain_count = 0;  // texels, as the converter counts them
  std::size_t nan_count = 0;            // texels with a NaN in roughness or specular
  std::size_t infinite_count = 0;       // texels with an infinity there
  std::size_t negative_count = 0;       // texels with a value below 0 there
  std::size_t clipped_count = 0;        // values, not texels, that an integer pixel type cut to its range

  PassStatistics& operator+=(const PassStatistics& other) noexcept;
};

struct PassOptions {
  int thread_count = 1;  // of the conversion; more than 1 also reads ahead and writes behind
  // Bytes that one band of the set may take; whole tiles come first. Two such bands are in memory, three
  // where pixel types change.
  std::size_t band_bytes = std::size_t{8} << 20;
  std::function<void(std::size_t rows_done)> progress;
  const std::atomic<bool>* cancelled = nullptr;  // looked at between bands
};

// Converts `set` into `target`, finishes both files and gives them their names. The values equal
// Converter::convert applied texel by texel, whatever the thread count and the band size, rounded to the
// pixel type of the file. Throws what the files throw; kInput where a roughness file of several channels is
// not grey; kInterrupted when cancelled. After an exception neither file has appeared (after a failing
// rename of the second, the first has).
PassStatistics run_texture_pass(TextureSet& set, TargetMaps& target, const Converter& converter,
                                const PassOptions& options);

}  // namespace remap
