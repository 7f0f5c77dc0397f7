// This file makes images with as many attributes as their formats can hold, in every variant of each format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace remap {

struct AttributeImage {
  std::string title;                   // the variant, for messages
  std::string extension;               // extension of the file
  std::vector<OIIO::ImageSpec> parts;  // one part, or several
  bool has_levels = false;             // mip levels below the only part
  bool is_lossless = true;             // true if every written bit is read back
};

std::vector<AttributeImage> exr_storage_images();    // pixel types, compressions, tiles, mip levels
std::vector<AttributeImage> exr_structure_images();  // layers, windows, parts
std::vector<AttributeImage> tiff_images();
std::vector<AttributeImage> png_images();
std::vector<AttributeImage> small_format_images();  // JPEG, Targa, BMP, Radiance

// Writes noise in all planes. Throws std::runtime_error if OpenImageIO fails.
void write_attribute_image(const std::filesystem::path& path, const AttributeImage& image);

// A StoredPlane describes one of all parts and levels as OpenImageIO does, with its texels as they are
// stored.
struct StoredPlane {
  OIIO::ImageSpec spec;
  std::vector<unsigned char> bytes;
};
std::vector<std::vector<StoredPlane>> read_planes(const std::filesystem::path& path);

}  // namespace remap
