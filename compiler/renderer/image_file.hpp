// Pictures of the sweep as files. The compiler's only contact with OpenImageIO.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "renderer/image.hpp"

namespace remapc {

// The R, G and B of a picture (EXR, HDR, any that OpenImageIO reads) as linear floats, whatever else it
// holds; one channel three times where it has only one. Throws kInput where it cannot be read or has two
// channels.
Image read_rgb(const std::filesystem::path& path);

// Writes a linear float32 EXR (zip), with `attributes` as metadata. `channels`: their names; where there are
// none, Y for one and R, G, B for three. Appears under its final name whole or not at all. Throws kOutput.
void write_exr(const std::filesystem::path& path, const Image& image,
               const std::map<std::string, std::string>& attributes,
               const std::vector<std::string>& channels = {});

// Writes display values, 0 to 1, as an 8-bit PNG. Appears under its final name whole or not at all. Throws
// kOutput.
void write_png(const std::filesystem::path& path, const Image& image);

// The bytes of such a PNG file. Throws kOutput where OpenImageIO cannot make it.
std::string png_bytes(const Image& image);

}  // namespace remapc
