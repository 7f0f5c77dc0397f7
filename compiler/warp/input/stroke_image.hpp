// Images on which strokes are painted: as large as the maps of the material they are for.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "warp/space/material.hpp"

namespace remapc {

// `96 x 64`.
std::string size_text(std::size_t width, std::size_t height);

// One channel: its values as they are stored, row by row from the top, 0 to 1 where the file has whole
// numbers.
using StrokeChannel = std::function<void(const std::vector<float>& values, bool is_alpha)>;

// Calls `use` with one channel after another, in the order of the file. Throws kInput for an image of another
// size than the material, and where it cannot be read.
void read_stroke_image(const std::filesystem::path& image, const MapFrame& material,
                       const StrokeChannel& use);

// Throws kInput, naming the image, where strokes of `marked` texels cover more than three quarters of it:
// they are most likely inverted.
void require_background(const std::filesystem::path& image, std::size_t marked, const MapFrame& material);

}  // namespace remapc
