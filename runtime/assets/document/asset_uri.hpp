// This file handles URIs in glTF files: data, files beside the asset, and remote addresses.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace remap {

// Returns `a b` for `a%20b`. A percent sign without two digits stays.
std::string percent_decoded(std::string_view text);

// Returns `a%20b` for `a b`. Only letters, digits and - . _ ~ stay (RFC 3986, section 2.3).
std::string percent_encoded(std::string_view text);

// These are all suffixes of names of new images.
inline constexpr std::array<std::string_view, 7> kNewImageSuffixes = {
    "_baseColor", "_metallicRoughness", "_roughness",         "_metallic",
    "_specular",  "_diffuse",           "_specularGlossiness"};

// Returns a path as a URI, with percent_encoded() between its slashes.
std::string uri_of_path(const std::string& path);

// Returns the name of a new file next to `model`, without number and extension. For `a/wood.jpg`, the prefix
// `chair_` and the suffix `_baseColor` it is `a/chair_wood_baseColor`. The suffix is one of kNewImageSuffixes
// or empty. Control characters and line breaks become `_`.
std::string stem_beside(const std::string& model, std::string_view prefix, std::string_view suffix);

enum class UriKind {
  kData,      // the bytes are in the URI
  kFile,      // a relative path; AssetResources decides how far up `..` may lead
  kAbsolute,  // a path from a root, a drive or a host
  kRemote,    // an address with another scheme, such as https
};
UriKind uri_kind(std::string_view uri);

// A NewImageNames finds free names for the new images of an asset.
class NewImageNames {
 public:
  // All names begin with `prefix` (AssetResources::image_prefix()).
  explicit NewImageNames(std::string prefix) : prefix_(std::move(prefix)) {}
  // Reserves a path that the asset uses already.
  void take(const std::string& path) { taken_.insert(path); }
  // Returns a free name, such as `a/wood_baseColor.png` for `a/wood.jpg`. If this name is taken, returns
  // `a/wood_baseColor_2.png`.
  std::string free_name(const std::string& model, std::string_view suffix);
  // Returns `.png`, or `_2.png` if `stem` with `.png` is taken.
  std::string free_ending(const std::string& stem, const char* extension);

 private:
  std::string prefix_;
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> numbers_;  // last number for each stem and extension
};

}  // namespace remap
