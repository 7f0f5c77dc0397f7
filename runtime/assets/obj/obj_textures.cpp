#include "assets/obj/obj_textures.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <utility>

#include "assets/document/asset_uri.hpp"
#include "core/json_spans.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr int kClampToEdge = 33071;  // value for samplers (glTF 2.0, section 5.26)

// Returns the type of an image that glTF can hold unchanged, otherwise an empty text.
const char* core_type_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
  return bytes.starts_with("\xff\xd8\xff") ? "image/jpeg" : "";
}

std::string stem_of(const std::string& path) {
  const std::string name = file_name_of(path);
  const std::size_t dot = name.find_last_of('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

}  // namespace

std::size_t GltfTextures::add_file(MtlImages& images, const MtlMap& map, std::vector<std::string>& warnings) {
  const std::string path = images.require(map, warnings);
  const std::string key = path + (map.has_levels() ? '\0' + map.options : "");
  if (const auto known = of_files_.find(key); known != of_files_.end()) return known->second;
  std::string bytes = images.bytes_of(path);
  const char* const type = core_type_of(bytes);
  std::size_t index = 0;
  if (*type == '\0' || map.has_levels()) {
    index = add_pixels(images, *images.load(map, warnings), map, "");
  } else if (place_ == NewImagePlace::kBuffer) {
    index = add_bytes(std::move(bytes), type, path);
  } else {
    index = add_uri(path);
    conversion_.resources.push_back({"", path, UriKind::kFile});
  }
  return of_files_[key] = index;
}

std::size_t GltfTextures::add_pixels(MtlImages& images, const ImagePixels& pixels, const MtlMap& model,
                                     std::string_view suffix) {
  std::string png = resources_.codec().encode_png(pixels, png_level_);
  const auto [known, is_new] =
      of_bytes_.try_emplace({png.size(), std::hash<std::string>()(png)}, images_.size());
  if (!is_new) return known->second;
  const std::string path = names_.free_name(images.place_of(model.file).value_or("material"), suffix);
  if (place_ == NewImagePlace::kBuffer) return add_bytes(std::move(png), "image/png", path);
  conversion_.files.push_back({path, std::move(png)});
  return add_uri(path);
}

std::size_t GltfTextures::add_bytes(std::string bytes, const char* type, const std::string& path) {
  images_.push_back(Json{{"bufferView", buffer_.add_view(std::move(bytes))},
                         {"mimeType", type},
                         {"name", utf8_name(stem_of(path))}});
  return images_.size() - 1;
}

std::size_t GltfTextures::add_uri(const std::string& path) {
  images_.push_back(Json{{"uri", uri_of_path(path)}});
  return images_.size() - 1;
}

// Converts coordinates. MTL counts v from the bottom: v' = s v + o becomes 1 - v' = s (1 - v) + 1 - s - o.
Json GltfTextures::info(std::size_t image, const MtlMap& map) {
  ++info_count_;
  const auto [known, is_new] = of_images_.try_emplace({image, map.clamps}, textures_.size());
  if (is_new) {
    if (samplers_.empty()) samplers_.push_back(Json::object());
    if (map.clamps && samplers_.size() < 2)
      samplers_.push_back(Json{{"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}});
    textures_.push_back(Json{{"source", image}, {"sampler", map.clamps ? 1 : 0}});
  }
  Json info{{"index", known->second}};
  if (map.scale == std::array{1.0, 1.0} && map.offset == std::array{0.0, 0.0}) return info;
  has_transforms_ = true;
  Json transform = Json::object();
  transform["offset"] =
      Json::list({float_value(map.offset[0]), float_value(1.0 - map.scale[1] - map.offset[1])});
  transform["scale"] = Json::list({float_value(map.scale[0]), float_value(map.scale[1])});
  info["extensions"] = Json::object();
  info["extensions"][std::string(kTextureTransform)] = std::move(transform);
  return info;
}

double float_value(double value) { return decimal_value(static_cast<float>(value)); }

std::string utf8_name(const std::string& text) {
  if (is_utf8(text)) return text;
  std::string result;
  for (const char c : text) result += utf8_of(static_cast<std::uint8_t>(c));
  return result;
}

}  // namespace remap
