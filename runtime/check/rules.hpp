// This file declares the rules that find mistakes in a material, each with the pattern that it detects.
// `convert` uses the rule for colors whose values contradict how they are read.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/material.hpp"
#include "core/plain_text.hpp"
#include "remap/pixels.hpp"
#include "sets/naming.hpp"

namespace remap {

enum class Confidence {
  kCertain,   // the files contradict each other or themselves
  kLikely,    // the pattern rarely has another cause
  kPossible,  // the user should have a look
};
inline constexpr NamedValues<Confidence, 3> kConfidences = {{{Confidence::kCertain, "certain"},
                                                             {Confidence::kLikely, "likely"},
                                                             {Confidence::kPossible, "possible"}}};

// A Fix describes how to fix what was found.
struct Fix {
  Fix() = default;
  Fix(std::string in_words, std::string as_command = "")
      : words(std::move(in_words)), command(std::move(as_command)) {}
  Fix(const char* in_words) : words(in_words) {}

  std::string words;  // what to edit; if there is a command, what the command does
  // This command can be typed in the folder where texremap was started. It writes into the folder `fixed`. It
  // may be empty.
  std::string command;
  // If the command converts an asset, these are the asset's file, the folder of results, and the options.
  // unite_conversions() makes one command from all findings.
  std::string asset = {}, output = {};
  std::vector<std::string> options = {};

  std::string text() const { return words + (command.empty() ? "" : ": " + command); }
};

struct MaterialFinding {
  std::string_view rule;  // name of the rule
  Confidence confidence = Confidence::kLikely;
  std::string context;  // name of the map or material in messages
  std::string channel;  // such as `G`; empty for the whole map
  std::string message;  // what was observed
  Fix fix;
};

// A GltfConsumer is a program for which files are checked, by its documentation (links: docs/check.md).
struct GltfConsumer {
  std::string_view name;
  std::string_view title;
  std::span<const std::string_view> ignored;  // extensions of glTF materials that it does not read
  bool ignores_factors_beside_maps = false;   // for metallic and roughness
  bool wants_directx_normals = false;
};
// Returns `gltf` (only the core), `unity`, `unreal`, `godot`, `threejs` and `usd`.
std::span<const GltfConsumer> gltf_consumers();

struct Rule {
  std::string_view name;
  std::string_view detects;  // the pattern in words
  void (*look)(const CheckedMaterial& material, const GltfConsumer* reader, const Rule& rule,
               std::vector<MaterialFinding>& findings);
};
// Returns all rules, in the order in which findings are shown.
std::span<const Rule> rules();

// Returns the findings of all rules in a material whose maps have been read. `reader` may be null.
std::vector<MaterialFinding> findings_in(const CheckedMaterial& material, const GltfConsumer* reader);

// This namespace holds rules for single maps, pairs of maps and statements of assets; rules() lists them.
namespace look {
using Look = void(const CheckedMaterial&, const GltfConsumer*, const Rule&, std::vector<MaterialFinding>&);
Look linear_color, specgloss_channels, specular_color, constant_map, banding, bad_values, metallic_greys,
    channel_order, normal_space, normal_orientation, wrong_texture;            // rules for single maps
Look srgb_data, sizes, gloss_as_roughness, alpha_as_roughness, duplicate_map;  // pairs
Look factor_zero, factor_ignored, index_of_refraction, ignored_by_reader, unreadable_statement,
    exponent_range;  // statements
}  // namespace look

// Combines all findings in an asset that a conversion fixes. They get one command with the options of all of
// them.
void unite_conversions(const std::vector<MaterialFinding*>& findings);

// Color roles are base color, diffuse and specular. Data roles are stored without a curve: widths, metallic,
// occlusion, normals and heights.
bool is_color_role(Role role);
bool is_data_role(Role role);

// Returns the folder for the results of a command: `fixed`, with the same subfolders as in the checked path.
std::filesystem::path fixed_folder(const CheckedMaterial& material);
// Returns a fix that changes the image of a map by oiiotool. For an image inside an asset, it has no command,
// because texremap cannot put the image back.
Fix image_fix(const CheckedMaterial& material, const MaterialMap& map, const std::string& words,
              const std::string& changes);
// Returns a number for each channel of a map: `value` for the channels of the use, and `otherwise` for the
// others. If channels have no names, all of them except alpha belong to the use.
std::string numbers_for(const CheckedMaterial& material, const MaterialUse& use, double value,
                        double otherwise);
// Returns options of oiiotool that replace x by 1 - x in the channels of a use.
std::string inversion_of(const CheckedMaterial& material, const MaterialUse& use);

struct ColorIssue {
  // This text is, for example, `read as linear, is 0.19 to 0.26 in 80 % of the texels, like F0 0.04 stored in
  // sRGB`.
  std::string text;
  std::optional<Transfer> transfer;  // the curve that would make the values plausible
};

// Finds a color map that is black or white everywhere, or whose F0 fits only the other transfer curve.
// `linear` has a row each for red, green and blue, or one row for grey. Its values were decoded by `transfer`
// and multiplied by the factors. Returns nothing for roles other than diffuse, base color and specular, and
// if there are no texels.
std::optional<ColorIssue> color_issue(Role role, Transfer transfer,
                                      const std::vector<std::vector<float>>& linear);

}  // namespace remap
