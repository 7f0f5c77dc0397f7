// A whole glTF file: its container, its materials, and the files that it names.
#pragma once

#include <string>
#include <vector>

#include "assets/asset_uri.hpp"
#include "assets/gltf_container.hpp"
#include "assets/gltf_specgloss.hpp"

namespace remap {

// A URI of a file that is not in the asset.
struct AssetResource {
  std::string where;  // `/images/2/uri`; only of the first that is kOutside, since counting takes time
  std::string path;   // relative to the asset, without percent signs; of kRemote the address
  UriKind kind = UriKind::kFile;
};

struct AssetConversion {
  SpecGlossResult result;
  std::vector<AssetPiece> pieces;        // of the converted file; empty where nothing was converted
  std::vector<AssetResource> resources;  // each path once, in the order of the text
  std::vector<std::string> warnings;     // of the file
};

// Reads and converts a file of either form. Throws kInput, beginning with `place`, for a container or a text
// that cannot be read, and for views that lie outside of their buffers; kOutput as with_json(). Without
// `resources`, materials with textures fail.
AssetConversion convert_asset(const ByteSource& source, const std::string& place,
                              const SpecGlossOptions& options = {},
                              const AssetResources* resources = nullptr);

}  // namespace remap
