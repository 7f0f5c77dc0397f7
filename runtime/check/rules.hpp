// Rules that find mistakes in a material, each with the pattern that it detects.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
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

// The repair of a finding.
struct Fix {
  Fix() = default;
  Fix(std::string in_words, std::string as_command = "")
      : words(std::move(in_words)), command(std::move(as_command)) {}
  Fix(const char* in_words) : words(in_words) {}

  std::string words;  // what to edit; if there is a command, what it does
  // Can be typed where texremap was started, and writes into the folder `fixed`; empty for none.
  std::string command;
  // If the command converts an asset: the asset's file, the folder of results and the options.
  // unite_conversions() makes one command of all findings.
  std::string asset = {}, output = {};
  std::vector<std::string> options = {};

  std::string text() const { return words + (command.empty() ? "" : ": " + command); }
};

struct MaterialFinding {
  std::string_view rule;  // name of the rule
  Confidence confidence = Confidence::kLikely;
  std::string context;  // the map or material, as messages show it
  std::string channel;  // `G`; empty for the whole map
  std::string message;  // what is seen
  Fix fix;
};

// A program that files are checked for, by its documentation (docs/check.md has the links).
struct GltfConsumer {
  std::string_view name;
  std::string_view title;
  std::span<const std::string_view> ignored;  // extensions of glTF materials that it does not read
  bool ignores_factors_beside_maps = false;   // of metallic and roughness
  bool wants_directx_normals = false;
};
// `gltf` (the core alone), `unity`, `unreal`, `godot`, `threejs`, `usd`.
std::span<const GltfConsumer> gltf_consumers();

struct Rule {
  std::string_view name;
  std::string_view detects;  // the pattern, in words
  void (*look)(const CheckedMaterial& material, const GltfConsumer* reader, const Rule& rule,
               std::vector<MaterialFinding>& findings);
};
// All rules, in the order in which findings are shown.
std::span<const Rule> rules();

// The findings of all rules in a material whose maps are read; `reader` may be null.
std::vector<MaterialFinding> findings_in(const CheckedMaterial& material, const GltfConsumer* reader);

// The rules of single maps, of pairs of maps and of what assets state; rules() lists them.
namespace look {
using Look = void(const CheckedMaterial&, const GltfConsumer*, const Rule&, std::vector<MaterialFinding>&);
Look linear_color, specgloss_channels, specular_color, constant_map, banding, bad_values, metallic_greys,
    channel_order, normal_space, normal_orientation, wrong_texture;            // single maps
Look srgb_data, sizes, gloss_as_roughness, alpha_as_roughness, duplicate_map;  // pairs
Look factor_zero, factor_ignored, index_of_refraction, ignored_by_reader, unreadable_statement,
    exponent_range;  // statements
}  // namespace look

// Gives the findings in one asset that its conversion puts right one command, with the options of all.
void unite_conversions(const std::vector<MaterialFinding*>& findings);

// Base color, diffuse, specular; and what is stored as it is: widths, metallic, occlusion, normals, heights.
bool is_color_role(Role role);
bool is_data_role(Role role);

// Where a command writes what it makes of a file: `fixed`, and there the same folders as in the checked
// path.
std::filesystem::path fixed_folder(const CheckedMaterial& material);
// Changes of the image of a map by oiiotool, in words and as its options. An image that is part of an asset
// has no command: nothing puts it back.
Fix image_fix(const CheckedMaterial& material, const MaterialMap& map, const std::string& words,
              const std::string& changes);
// A number for each channel of a map: `value` for that of the use, `otherwise` for the others. All channels
// of a map without names of channels are of the use, but for alpha.
std::string numbers_for(const CheckedMaterial& material, const MaterialUse& use, double value,
                        double otherwise);
// Options of oiiotool that make 1 - x of the channels of a use.
std::string inversion_of(const CheckedMaterial& material, const MaterialUse& use);

}  // namespace remap
