// What looks wrong in a material: rules, each with the pattern that it sees.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "check/material.hpp"
#include "core/plain_text.hpp"

namespace remap {

enum class Confidence {
  kCertain,   // the files contradict each other or themselves
  kLikely,    // the pattern has hardly another cause
  kPossible,  // worth a look
};
inline constexpr NamedValues<Confidence, 3> kConfidences = {{{Confidence::kCertain, "certain"},
                                                             {Confidence::kLikely, "likely"},
                                                             {Confidence::kPossible, "possible"}}};

struct MaterialFinding {
  std::string_view rule;  // name of the rule
  Confidence confidence = Confidence::kLikely;
  std::string place;    // the map or material, as messages show it
  std::string channel;  // `G`; empty for the whole map
  std::string message;  // what is seen
  std::string mend;     // a command, or an edit of the file
};

// A program that files are checked for, by its documentation (docs/check.md has the links).
struct TargetReader {
  std::string_view name;
  std::string_view title;
  std::span<const std::string_view> ignored;  // extensions of glTF materials that it does not read
  bool ignores_factors_beside_maps = false;   // of metallic and roughness
  bool wants_directx_normals = false;
};
// `gltf` (the core alone), `unity`, `unreal`, `godot`, `threejs`, `usd`.
std::span<const TargetReader> target_readers();

struct Rule {
  std::string_view name;
  std::string_view sees;  // the pattern, in words
  void (*look)(const CheckedMaterial& material, const TargetReader* reader, const Rule& rule,
               std::vector<MaterialFinding>& findings);
};
// All rules, in the order in which findings are shown.
std::span<const Rule> rules();

// What all rules find in a material whose maps are read; `reader` may be null.
std::vector<MaterialFinding> findings_in(const CheckedMaterial& material, const TargetReader* reader);

// The rules of single maps, of pairs of maps and of what assets state; rules() lists them.
namespace look {
using Look = void(const CheckedMaterial&, const TargetReader*, const Rule&, std::vector<MaterialFinding>&);
Look linear_color, specgloss_channels, constant_map, banding, bad_values, metallic_greys, channel_order,
    normal_space, normal_orientation, wrong_texture;                           // single maps
Look srgb_data, sizes, gloss_as_roughness, alpha_as_roughness, duplicate_map;  // pairs
Look factor_zero, factor_ignored, index_of_refraction, ignored_by_reader, unreadable_statement,
    exponent_range;  // statements
}  // namespace look

// Base color, diffuse, specular; and what is stored as it is: widths, metallic, occlusion, normals, heights.
bool is_color_role(Role role);
bool is_data_role(Role role);
// A command that rewrites the roughness of a material from what its maps hold.
std::string width_command(const CheckedMaterial& material, std::string_view encoding);

}  // namespace remap
