// The maps that describe one material: which channels of which files hold what a converter asks for.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "texture/image_io.hpp"

namespace remap {

// Linear specular without a map: one value for grey, or one each for red, green and blue.
using ConstantSpecular = std::vector<float>;
using SpecularSource = std::variant<std::filesystem::path, ConstantSpecular>;

// `0.5` or `0.9,0.6,0.2` is a constant, anything else a file. Throws kUsage for a list of numbers that is
// neither one nor three long or that holds a negative or infinite one.
SpecularSource specular_source(std::string_view text);

// What a caller names.
struct TextureSetRequest {
  std::filesystem::path roughness;
  SpecularSource specular;
  std::optional<std::string> roughness_channel;  // by name, where the roughness file holds more than one
};

// One file of a set and its channels that are converted; every other channel passes through.
struct SourceMap {
  ImageReader reader;
  std::vector<std::size_t> channels;  // indices into reader.layout().channels
  // The channels are copies of one value: read the first, check the others, write all.
  bool copies = false;
};

// An open set: every texel has one roughness and one or three specular values.
struct TextureSet {
  SourceMap roughness;
  std::variant<SourceMap, ConstantSpecular> specular;

  int width() const noexcept { return roughness.reader.layout().width; }
  int height() const noexcept { return roughness.reader.layout().height; }
  std::size_t specular_channel_count() const noexcept;
};

// Opens the files and finds the channels. Throws kInput where a file cannot be read, where a channel is
// missing, and where two maps do not cover the same texels; kUsage for an unknown `roughness_channel`.
TextureSet open_texture_set(const TextureSetRequest& request);

// What a person should know about the set before trusting the result; one message each, without place.
std::vector<std::string> doubts(const TextureSet& set);

}  // namespace remap
