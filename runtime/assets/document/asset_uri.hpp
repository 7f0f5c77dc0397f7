// URIs of buffers and images in glTF files: data, files beside the asset, addresses elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace remap {

// `a b` of `a%20b`. A percent sign without two digits stays.
std::string percent_decoded(std::string_view text);

// `a%20b` of `a b`: everything but letters, digits and - . _ ~ (RFC 3986, section 2.3).
std::string percent_encoded(std::string_view text);

// Every suffix that names of new images have.
inline constexpr std::array<std::string_view, 7> kNewImageSuffixes = {
    "_baseColor", "_metallicRoughness", "_roughness",         "_metallic",
    "_specular",  "_diffuse",           "_specularGlossiness"};

// A path as a URI: percent_encoded() between its slashes.
std::string uri_of_path(const std::string& path);

// What a new file beside `model` is named, without number and extension: `a/chair_wood_baseColor` of
// `a/wood.jpg`, the prefix `chair_` and the suffix `_baseColor`, which is one of kNewImageSuffixes or empty.
// Control characters and line breaks become `_`.
std::string stem_beside(const std::string& model, std::string_view prefix, std::string_view suffix);

enum class UriKind {
  kData,      // the bytes are in the URI
  kFile,      // a relative path; whether its `..` lead too far up, AssetResources decide
  kAbsolute,  // a path from a root, a drive or a host
  kRemote,    // of another scheme, such as https
};
UriKind uri_kind(std::string_view uri);

// Free names for the new images of an asset.
class NewImageNames {
 public:
  // Names begin with `prefix` (AssetResources::image_prefix()).
  explicit NewImageNames(std::string prefix) : prefix_(std::move(prefix)) {}
  // The asset uses this path already.
  void take(const std::string& path) { taken_.insert(path); }
  // `a/wood_baseColor.png` for `a/wood.jpg`, or `a/wood_baseColor_2.png` if that name is taken.
  std::string free_name(const std::string& model, std::string_view suffix);
  // `.png`, or `_2.png` if `stem` with `.png` is taken.
  std::string free_ending(const std::string& stem, const char* extension);

 private:
  std::string prefix_;
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> numbers_;  // of the last name of each stem and extension
};

}  // namespace remap
