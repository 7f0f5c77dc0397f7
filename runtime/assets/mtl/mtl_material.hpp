// This file reads a material of an MTL file: its numbers and maps, and the lobes that they describe.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/mtl_document.hpp"
#include "assets/maps/legacy_maps.hpp"

namespace remap {

// Reads a finite number, which may have a plus sign. Returns nothing for any other text.
std::optional<double> mtl_number(std::string_view text);

// An MtlMap is a texture: `map_Kd -s 2 2 wood.jpg`.
struct MtlMap {
  std::size_t statement = 0;  // index of the statement
  TextSpan name;              // place in the text
  std::string file;           // the name with '/' between folders; may hold spaces; may be empty
  std::string options;        // the options before and after the name, as written
  std::array<double, 2> scale = {1.0, 1.0}, offset = {0.0, 0.0};  // -s and -o: u and v
  double strength = 1.0;                                          // option -bm
  bool clamps = false;                                            // option -clamp on
  char channel = '\0';                                            // -imfchan, or 0
  double base = 0.0, gain = 1.0;     // -mm: base + gain times a stored value, kept within 0 to 1
  std::vector<TextSpan> levels;      // places of -mm and of the white space after it
  bool is_color = false;             // if false, all channels are data, alpha too
  std::vector<std::string> unusual;  // options that change the look, and are not applied

  // Returns true if both maps lie in the same place on the surface.
  bool lies_like(const MtlMap& other) const {
    return scale == other.scale && offset == other.offset && clamps == other.clamps;
  }
  // Returns true if -mm changes the values of the file.
  bool has_levels() const { return base != 0.0 || gain != 1.0; }
};

// Reads the file of a statement. Options may also follow the name, as some tools write them.
MtlMap read_mtl_map(const MtlDocument& document, std::size_t statement);

// An MtlSurface holds the properties that reflect light. If a statement occurs several times, the last one is
// used, as in other programs.
struct MtlSurface {
  std::optional<std::array<double, 3>> diffuse, specular;  // Kd, Ks, clamped to 0 and 1
  std::optional<double> exponent;                          // Ns, at most 10000; may be below 0
  std::optional<double> illumination;                      // value of illum
  std::optional<double> ambient;                           // red of Ka
  std::optional<double> roughness, metallic;               // Pr, Pm
  std::optional<double> specular_level;  // 1 means F0 0.04; only set for makers that write such a level
  std::optional<MtlMap> diffuse_map, specular_map, exponent_map, reflection_map, roughness_map, metallic_map;
  bool has_pbr_bsdf = false;                     // bsdf pbr
  bool is_metal_rough = false;                   // true if Pr, Pm or the maker give metallic and roughness
  std::optional<std::size_t> diffuse_statement;  // statement Kd; without it, makers have different defaults
  std::size_t last_statement = 0;                // last statement of the material

  bool is_empty() const {
    return !diffuse && !specular && !exponent && !diffuse_map && !specular_map && !exponent_map;
  }
};

// Returns true if a material has lines Pr, Pm, map_Pr or map_Pm, as later tools add them.
bool has_metal_rough_lines(const MtlDocument& document, const MtlBlock& block);

// Reads the surface as its maker means it. Appends warnings. Throws kInput, without the name of the material,
// if a number cannot be read or a color is not RGB; `surface` then holds the other statements.
void read_mtl_surface(const MtlDocument& document, const MtlBlock& block, MtlMaker maker, MtlSurface& surface,
                      std::vector<std::string>& warnings);

// An MtlCover holds opacity and emission of the surface.
struct MtlCover {
  std::optional<double> opacity;       // d, 0 to 1
  std::optional<double> transparency;  // Tr, 0 to 1
  std::array<double, 3> emissive{};    // Ke
  bool has_emissive = false;
  bool has_displacement = false;                   // disp
  std::optional<double> refraction;                // Ni
  std::array<double, 3> filter = {1.0, 1.0, 1.0};  // Tf, 0 to 1
  bool refracts = false;                           // illum 4, 6, 7 or 9
  // By the specification, bump_map holds heights, but most exporters write normals (holds_normals()).
  std::optional<MtlMap> opacity_map, emissive_map, normal_map, bump_map;
};

// Reads the cover. Throws like read_mtl_surface().
MtlCover read_mtl_cover(const MtlDocument& document, const MtlBlock& block, MtlMaker maker,
                        std::vector<std::string>& warnings);

// Returns metallic and roughness of a surface as numbers. If one of them has a map, its number is 1, and the
// number in the file is ignored. If `is_core` is set, the target adds a highlight to dielectrics. A
// dielectric without a highlight then becomes rough.
MetalRoughFactors metal_rough_of(const MtlSurface& surface, bool is_core);

// Returns the factors of a surface, which multiply its maps. Without a highlight, specular is black. Fills in
// missing values, and appends a warning for each: Kd .8 and Ns 0, Ks 0, or 1 with a map. These
// follow J. Burkardt's description of MTL, because Alias|Wavefront's has no defaults. Throws kInput if a map
// multiplies a missing exponent.
LegacyMaterial reflection_of(const MtlSurface& surface, std::vector<std::string>& warnings);

}  // namespace remap
