// This file enlarges the image of an asset in memory.
#pragma once

#include "assets/document/image_codec.hpp"

namespace remap {

// Implements AssetResources::enlarged() (assets/document/asset.hpp).
ImagePixels enlarged_pixels(const ImagePixels& pixels, std::size_t width, std::size_t height);

}  // namespace remap
