// This file runs texremap in a temporary folder, with images to convert and folders of texture sets.
#pragma once

#include <Imath/half.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

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

using Names = std::vector<std::string>;
inline const Names kGrey = {"Y"}, kColor = {"R", "G", "B"}, kWithAlpha = {"R", "G", "B", "A"};
inline constexpr int kMapSize = 24;

class Session : public CommandFolder {
 public:
  ProcessResult texremap(const Words& words, const ProcessLimits& limits = {}) const {
    return run(REMAP_TEXREMAP + words, limits);
  }
  ProcessResult texremap_with(const std::string& instructions, const Words& words) const {
    return run(Words("/usr/bin/env REMAP_INSTRUCTIONS=" + instructions) + REMAP_TEXREMAP + words);
  }
  // Returns the JSON that a command prints, which must succeed.
  nlohmann::json json(const Words& words) const {
    return nlohmann::json::parse(require_success(texremap(words)).output);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  TestImage image(const std::string& name) const { return read_image(path(name)); }
  // Returns the first texel, in steps of 8 bits.
  std::vector<int> texel(const std::string& name) const {
    const TestImage found = image(name);
    std::vector<int> values;
    for (int c = 0; c < found.spec.nchannels; ++c)
      values.push_back(static_cast<int>(std::lround(255.0f * found.at(0, 0, c))));
    return values;
  }
  // The following functions write a file, and make its folder.
  void put(const std::string& name, const std::string& content) const { write_file(path(name), content); }
  void make(const std::string& name, const OIIO::ImageSpec& spec, const TexelFunction& texel) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    write_image(path(name), spec, texel);
  }
  void map(const std::string& name, const Names& channels, const TexelFunction& texel = noise,
           OIIO::TypeDesc type = OIIO::TypeUInt8, int size = kMapSize) const {
    make(name, test_spec(size, size, channels, type), texel);
  }
  void map(const std::string& name, const Names& channels, OIIO::TypeDesc type, int size = kMapSize) const {
    map(name, channels, noise, type, size);
  }
  // Writes a map of one color.
  void flat(const std::string& name, const std::vector<float>& values, OIIO::TypeDesc type = OIIO::TypeUInt8,
            int size = kMapSize) const {
    const Names& channels = values.size() == 1 ? kGrey : values.size() == 3 ? kColor : kWithAlpha;
    map(
        name, channels, [&](int, int, int c) { return values[static_cast<std::size_t>(c)]; }, type, size);
  }
  // Converts two files into the folder `out`.
  ProcessResult convert(const std::string& roughness, const std::string& specular, const Words& more = {},
                        const ProcessLimits& limits = {}) const {
    return texremap(kConversion + " --roughness " + roughness + " --specular " + specular + more, limits);
  }
  // Converts the sets of the folder `in` into the folder `out`.
  ProcessResult convert_tree(const Words& more = {}, const ProcessLimits& limits = {}) const {
    return texremap(kConversion + " in --color-space linear" + more, limits);
  }
  // Writes r.<extension> and s.<extension> with noise.
  void write_pair(const std::string& extension, int size = 64, OIIO::TypeDesc type = OIIO::TypeHalf) const {
    map("r." + extension, kGrey, type, size);
    map("s." + extension, kColor, type, size);
  }
  // Writes both maps of a set, such as `in/a_rough.png` and `in/a_spec.png`.
  void write_set(const std::string& name, const std::string& extension, OIIO::TypeDesc type = OIIO::TypeUInt8,
                 int size = kMapSize) const {
    map(name + "_rough." + extension, kGrey, type, size);
    map(name + "_spec." + extension, kColor, type, size);
  }
  // Returns every file below the folder except files that texremap notes, relative to the folder, with its
  // content.
  std::map<std::string, std::string> contents(const std::string& folder = "out") const {
    std::map<std::string, std::string> files;
    std::error_code none;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path(folder), none)) {
      const std::string name = std::filesystem::relative(entry.path(), path(folder)).string();
      if (entry.is_regular_file() && !name.starts_with(".texremap")) files[name] = read_file(entry.path());
    }
    return files;
  }
  Names results() const {
    Names names;
    for (const auto& entry : contents()) names.push_back(entry.first);
    return names;
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

// Returns the lines of a folder's report as one object: the sets by name, what was skipped, the conversion
// and the summary.
inline nlohmann::json tree_report(const std::string& output) {
  nlohmann::json report = {{"sets", nlohmann::json::array()}, {"skipped", nlohmann::json::array()}};
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    if (json.contains("set")) report["sets"].push_back(json["set"]);
    if (json.contains("skipped")) report["skipped"].push_back(json["skipped"]);
    for (const char* name : {"conversion", "summary"})
      if (json.contains(name)) report[name] = json[name];
  }
  auto& sets = report["sets"];
  std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a["name"] < b["name"]; });
  return report;
}

// Returns the states of the sets by their first letters: c (converted), d (done before), f (failed).
inline std::string set_states(const std::string& output) {
  std::string letters;
  const auto report = tree_report(output);
  for (const auto& set : report["sets"]) letters += set["state"].get<std::string>().front();
  return letters;
}

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
