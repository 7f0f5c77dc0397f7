// Images of strokes, which must have the size of the material's maps.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "warp/space/material.hpp"

namespace remapc {

// For example `96x64`.
std::string size_text(std::size_t width, std::size_t height);

// Receives one channel: its stored values, row-major from the top; integers are scaled to 0 to 1.
using StrokeChannel = std::function<void(const std::vector<float>& values, bool is_alpha)>;

// Calls `use` for each channel in the order of the file. Throws kInput if the image cannot be read or its
// size differs from that of the material.
void read_stroke_image(const std::filesystem::path& image, const MapFrame& material,
                       const StrokeChannel& use);

// Throws kInput with the name of the image if `marked` is more than three quarters of the texels, because
// such an image is most likely inverted.
void require_background(const std::filesystem::path& image, std::size_t marked, const MapFrame& material);

}  // namespace remapc
