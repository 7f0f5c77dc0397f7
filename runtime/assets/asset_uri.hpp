// URIs of buffers and images in glTF files: data, files beside the asset, addresses elsewhere.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace remap {

// `a b` of `a%20b`. A percent sign without two digits stays.
std::string percent_decoded(std::string_view text);

enum class UriKind {
  kData,     // the bytes are in the URI
  kFile,     // a relative path below the folder of the asset
  kOutside,  // an absolute path, or one that leads out of the folder
  kRemote,   // of another scheme, such as https
};
UriKind uri_kind(std::string_view uri);

}  // namespace remap
