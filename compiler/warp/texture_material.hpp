// This file reads folders as materials of a warp: texture sets, and tables of measured BRDFs or scattering
// profiles. It also writes the exact copy of a warp to files. In it, each source texel is a copy of one
// template texel.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "texture/image_reader.hpp"
#include "warp/material.hpp"

namespace remap {

// An AlbedoAlone decides how to read a folder that has neither roughness nor specular.
enum class AlbedoAlone {
  kRefuse,
  kEnrich,  // diffuse or base color with specular 0 and alpha 1 (An et al. 2011, section 4)
};

// Reads the only set of `folder`, which is found by the names of its maps (runtime/sets). The set has
// diffuse, specular (F0 or scale of `model`), and roughness, glossiness or alpha, which become alpha. Or it
// has base color and metallic, which are converted by equation (2). All maps must have the same size. Throws
// kInput for missing and ambiguous maps, and kUsage for a model that the built-in renderer does not have.
WarpMaterial read_texture_material(const std::filesystem::path& folder, const std::string& model,
                                   AlbedoAlone albedo = AlbedoAlone::kRefuse);

// These are the names of files of all kinds.
inline constexpr std::array<const char*, 8> kCopyNames = {"diffuse.exr",  "specular.exr",      "alpha.exr",
                                                          "profiles.exr", "index.exr",         "profiles.csv",
                                                          "brdfs.txt",    "template_texel.exr"};

// Writes float32 EXR files of the source's size to `folder`, with NaN in skipped texels:
//   parameters         diffuse.exr, specular.exr, alpha.exr
//   a list             index.exr and the list (profiles.csv, or brdfs.txt with adapted paths)
//   profiles.exr       profiles.exr
//   all kinds          template_texel.exr: channels X and Y, the position in the template from 0 at the top
//                      left, by which other maps can be copied
// `texels` is the result of copy_exactly(). Returns the files. Throws kOutput.
std::vector<std::filesystem::path> write_copied_set(const std::filesystem::path& folder,
                                                    const std::vector<std::uint32_t>& texels,
                                                    const MaterialRef& source, const MaterialRef& goal);

bool is_tabulated_folder(const std::filesystem::path& folder);

// Reads a folder that contains one of
//   profiles.exr                one profile per texel: channels `R@<radius>`, `G@<radius>`, `B@<radius>` for
//                               each radius, or `Y@<radius>` if the profile is grey
//   profiles.csv and a map      columns with the same names, one row per profile; the first is entry 0
//   brdfs.txt and a map         one file of a measured BRDF per line, relative to the folder, in the format
//                               of the MERL database (Matusik et al. 2003); the first is entry 0
// The map is index.exr, .png or .tif with one channel: the number of each texel's entry. Texels with another
// value are skipped. Radii of source and template must have the same unit.
// Throws kInput for a folder without a table, a file that cannot be read, and unknown columns
// or channels. Also throws it for radii that differ between channels, and negative or infinite values.
TabulatedMaterial read_tabulated_set(const std::filesystem::path& folder);

// Returns all rows of an image in its layout. Throws the errors of read_rows().
inline std::vector<std::byte> texels_of(ImageReader& image) {
  const ImageLayout& layout = image.layout();
  std::vector<std::byte> texels(static_cast<std::size_t>(layout.height) * layout.row_bytes());
  image.read_rows(0, layout.height, texels.data());
  return texels;
}

// Returns the stored values of one channel, row-major from the top. Integers are scaled to 0 to 1.
inline std::vector<float> channel_values(const ImageLayout& layout, std::size_t channel,
                                         const std::vector<std::byte>& texels) {
  const Channel& own = layout.channels[channel];
  std::vector<float> values(static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height));
  load_values(own.type, texels.data() + own.offset, layout.texel_bytes, values.size(), values.data());
  return values;
}

}  // namespace remap
