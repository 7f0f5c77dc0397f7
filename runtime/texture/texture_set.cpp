#include "texture/texture_set.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>

#include "error.hpp"
#include "nearest_name.hpp"
#include "number_text.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> channel_names(const ImageLayout& layout) {
  std::vector<std::string> names;
  for (const Channel& channel : layout.channels) names.push_back(channel.name);
  return names;
}

std::string listed(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::optional<std::size_t> find_channel(const ImageLayout& layout, std::string_view name) {
  const auto same = [&](const Channel& channel) {
    return std::equal(channel.name.begin(), channel.name.end(), name.begin(), name.end(),
                      [](char a, char b) { return std::toupper(static_cast<unsigned char>(a)) == b; });
  };
  const auto found = std::find_if(layout.channels.begin(), layout.channels.end(), same);
  if (found == layout.channels.end()) return std::nullopt;
  return static_cast<std::size_t>(found - layout.channels.begin());
}

// R, G and B, or Y, or the only channel that is not alpha; empty where the file has none of them.
std::vector<std::size_t> colour_channels(const ImageLayout& layout) {
  const auto red = find_channel(layout, "R"), green = find_channel(layout, "G"),
             blue = find_channel(layout, "B");
  if (red && green && blue) return {*red, *green, *blue};
  if (const auto grey = find_channel(layout, "Y")) return {*grey};
  const bool has_alpha = layout.alpha_channel >= 0;
  if (layout.channels.size() != (has_alpha ? 2u : 1u)) return {};
  return {layout.alpha_channel == 0 && has_alpha ? std::size_t{1} : std::size_t{0}};
}

[[noreturn]] void fail_missing(const ImageReader& reader, const std::string& expected) {
  throw Error(ErrorKind::kInput, reader.path().string() + ": has the channels " +
                                     listed(channel_names(reader.layout())) + "; expected " + expected);
}

SourceMap open_roughness(const TextureSetRequest& request) {
  SourceMap map{ImageReader(request.roughness), {}, false};
  const ImageLayout& layout = map.reader.layout();
  if (request.roughness_channel) {
    const std::vector<std::string> names = channel_names(layout);
    const auto found = std::find(names.begin(), names.end(), *request.roughness_channel);
    if (found == names.end())
      throw Error(ErrorKind::kUsage, request.roughness.string() + ": has no channel " +
                                         *request.roughness_channel +
                                         suggestion(*request.roughness_channel, names));
    map.channels = {static_cast<std::size_t>(found - names.begin())};
    return map;
  }
  map.channels = colour_channels(layout);
  if (map.channels.empty())
    fail_missing(map.reader, "one channel, Y, or R, G and B; --roughness-channel NAME picks one");
  map.copies = map.channels.size() > 1;
  return map;
}

SourceMap open_specular(const fs::path& path) {
  SourceMap map{ImageReader(path), {}, false};
  map.channels = colour_channels(map.reader.layout());
  if (map.channels.empty()) fail_missing(map.reader, "R, G and B, or one channel");
  return map;
}

std::string window_text(const ImageLayout& layout) {
  std::string text = std::to_string(layout.width) + " x " + std::to_string(layout.height);
  if (layout.x != 0 || layout.y != 0)
    text += " at (" + std::to_string(layout.x) + ", " + std::to_string(layout.y) + ")";
  return text;
}

void require_same_texels(const ImageReader& roughness, const ImageReader& specular) {
  const ImageLayout &a = roughness.layout(), &b = specular.layout();
  if (a.width == b.width && a.height == b.height && a.x == b.x && a.y == b.y) return;
  throw Error(ErrorKind::kInput, specular.path().string() + ": is " + window_text(b) +
                                     "; expected the size of " + roughness.path().string() + ", " +
                                     window_text(a));
}

}  // namespace

SpecularSource specular_source(std::string_view text) {
  ConstantSpecular values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto number = parse_number(text.substr(begin, end - begin));
    if (!number) return fs::path(text);
    values.push_back(static_cast<float>(*number));
    begin = end + 1;
  }
  const bool usable = std::all_of(values.begin(), values.end(),
                                  [](float value) { return std::isfinite(value) && value >= 0.0f; });
  if (!usable || (values.size() != 1 && values.size() != 3))
    throw Error(ErrorKind::kUsage, "--specular: is " + std::string(text) +
                                       "; expected a file, or one or three finite values from 0");
  return values;
}

std::size_t TextureSet::specular_channel_count() const noexcept {
  if (const auto* map = std::get_if<SourceMap>(&specular)) return map->channels.size();
  return std::get_if<ConstantSpecular>(&specular)->size();
}

TextureSet open_texture_set(const TextureSetRequest& request) {
  SourceMap roughness = open_roughness(request);
  if (const auto* constant = std::get_if<ConstantSpecular>(&request.specular))
    return {std::move(roughness), *constant};
  SourceMap specular = open_specular(std::get<fs::path>(request.specular));
  require_same_texels(roughness.reader, specular.reader);
  return {std::move(roughness), std::move(specular)};
}

std::vector<std::string> doubts(const TextureSet& set) {
  std::vector<std::string> messages;
  const auto* specular = std::get_if<SourceMap>(&set.specular);
  if (specular == nullptr) return messages;
  const ImageLayout& layout = specular->reader.layout();
  if (layout.is_tagged_nonlinear && is_integer(layout.channels[specular->channels.front()].type))
    messages.push_back(specular->reader.path().string() +
                       ": is tagged as not linear (sRGB); its values are read as linear");
  return messages;
}

}  // namespace remap
