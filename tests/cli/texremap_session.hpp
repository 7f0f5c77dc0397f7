// This file runs texremap in a temporary folder with images to convert.
#pragma once

#include <Imath/half.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "remap/converter.hpp"
#include "remap/shipped_converters.hpp"
#include "support/process.hpp"
#include "support/srgb.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"

namespace remap {

// This file lies next to the results of a run.
inline constexpr const char* kJournal = ".texremap.jsonl";

// This conversion writes into the folder `out`.
inline const std::string kConversion = "convert --from mitsuba/ward --to mitsuba/as -o out";

class Session : public CommandFolder {
 public:
  ProcessResult texremap(const Words& words, const ProcessLimits& limits = {}) const {
    return run(REMAP_TEXREMAP + words, limits);
  }
  ProcessResult texremap_with(const std::string& instructions, const Words& words) const {
    return run(Words("/usr/bin/env REMAP_INSTRUCTIONS=" + instructions) + REMAP_TEXREMAP + words);
  }
  TestImage image(const std::string& name) const { return read_image(path(name)); }
  void make(const std::string& name, const OIIO::ImageSpec& spec, const TexelFunction& texel) const {
    write_image(path(name), spec, texel);
  }
  // Converts two files into the folder `out`.
  ProcessResult convert(const std::string& roughness, const std::string& specular, const Words& more = {},
                        const ProcessLimits& limits = {}) const {
    return texremap(kConversion + " --roughness " + roughness + " --specular " + specular + more, limits);
  }
  // Writes r.<extension> and s.<extension> with noise.
  void write_pair(const std::string& extension, int size = 64, OIIO::TypeDesc type = OIIO::TypeHalf) const {
    write_image(path("r." + extension), test_spec(size, size, {"Y"}, type), noise);
    write_image(path("s." + extension), test_spec(size, size, {"R", "G", "B"}, type), noise);
  }
  // Return the number of files in `out` besides the journal, without and with hidden files.
  std::size_t result_count() const { return count(false); }
  std::size_t file_count() const { return count(true); }

 private:
  std::size_t count(bool hidden_too) const {
    std::size_t files = 0;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(path("out"), none))
      files += entry.path().filename() != kJournal &&
               (hidden_too || entry.path().filename().string().front() != '.');
    return files;
  }
};

// Converts one texel from Ward to Ashikhmin-Shirley: the roughness, then the specular channels.
inline std::array<float, 4> converted_texel(float roughness, const std::array<float, 3>& specular) {
  std::array<float, 4> result{};
  const std::array<const float*, 3> in = {&specular[0], &specular[1], &specular[2]};
  const std::array<float*, 3> out = {&result[1], &result[2], &result[3]};
  find_converter("mitsuba/ward", "mitsuba/as").convert(1, &roughness, in, &result[0], out);
  return result;
}

// Returns `value` as a file of this pixel type stores it.
inline float as_stored(float value, OIIO::TypeDesc type) {
  const auto whole = [value](double largest) {
    const double clipped = std::isnan(value) ? 0.0 : std::min(std::max(static_cast<double>(value), 0.0), 1.0);
    return static_cast<float>(std::floor(clipped * largest + 0.5)) / static_cast<float>(largest);
  };
  if (type == OIIO::TypeUInt8) return whole(255.0);
  if (type == OIIO::TypeUInt16) return whole(65535.0);
  if (type == OIIO::TypeHalf) return static_cast<float>(Imath::half(value));
  return value;
}

inline bool is_whole(OIIO::TypeDesc type) { return type == OIIO::TypeUInt8 || type == OIIO::TypeUInt16; }

// Returns the linear value of a color. Integers are sRGB.
inline float color_read(float stored, OIIO::TypeDesc type) {
  return is_whole(type) ? static_cast<float>(srgb_to_linear(static_cast<double>(stored))) : stored;
}
// Returns true if `stored` is the color `value`, within half a step and the rounding of floats in 16 bits.
inline bool is_color_stored(float stored, float value, OIIO::TypeDesc type) {
  if (!is_whole(type)) return stored == as_stored(value, type);
  const double step = 1.0 / (type == OIIO::TypeUInt8 ? 255.0 : 65535.0);
  const double expected = std::clamp(linear_to_srgb(static_cast<double>(value)), 0.0, 1.0);
  return std::fabs(static_cast<double>(stored) - expected) <= (type == OIIO::TypeUInt8 ? 0.51 : 0.6) * step;
}

}  // namespace remap
