// This file describes the arrangement of results in files.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "remap/converter.hpp"
#include "remap/model.hpp"
#include "remap/pixels.hpp"
#include "texture/normal_green.hpp"

namespace remap {

// A LayoutParameter is a parameter that a conversion makes or passes through, in one channel or three.
struct LayoutParameter {
  Parameter parameter = Parameter::kRoughness;
  std::optional<RoughnessEncoding> width;  // for kRoughness: roughness or glossiness
};
// A LayoutContent is roughness, metallic and so on, the name of a parameter that is passed through and never
// converted (`occlusion`), or a stored value from 0 to 1.
using LayoutContent = std::variant<LayoutParameter, std::string, float>;

struct LayoutFile {
  std::string name;                    // without extension; the set's name replaces `*`, or is put in front
  std::vector<LayoutContent> content;  // content of 1, 3 or 4 channels
};

struct Layout {
  std::string name;
  bool keeps_names = false;       // every map with a converted channel keeps its name
  std::vector<LayoutFile> files;  // every other result is a separate file, named after its parameter

  // Returns the encoding of roughness in these files, or nothing if roughness has a separate file.
  std::optional<RoughnessEncoding> width() const;
  // Returns the file with `parameter`, or null.
  const LayoutFile* file_with(Parameter parameter) const;
  // Returns true if a file has a channel for a carried parameter, such as `occlusion` or `metallic`.
  bool has_place_for(std::string_view carried) const;
  bool operator==(const Layout& other) const { return name == other.name; }
};

// Returns the layout in which each map with a converted channel keeps its name.
Layout as_inputs();
// Returns the layout with one file each for roughness, colors and carried parameters.
Layout separate();

// A NamedLayout is a layout with a name. The layout of an engine or tool has the maps that its documentation
// describes (docs/presets.md has the links).
struct NamedLayout {
  std::string_view name;
  std::string_view words;   // words of `--to` for this layout; `--to gltf` means only the material
  std::string_view files;   // text for layout_from(); if empty, as separate()
  std::string_view format;  // extension of the files; empty for as-inputs and layouts without an engine
  std::optional<PixelType> type;
  std::optional<NormalGreen> normals;  // direction of green in normal maps, if documented
};
// Returns `as-inputs`, `separate`, `orm`, `arm`, `specgloss`, and engines: `gltf`, `unity`, `unreal`, ...
std::span<const NamedLayout> named_layouts();
std::span<const NamedLayout> engine_layouts();
// Returns the engine's layout for a name or for a word of `--to`, or null.
const NamedLayout* engine_layout(std::string_view name);
const NamedLayout* engine_layout_of(std::string_view word);

// Reads a layout from its name, or from text such as `MaskMap=metallic,occlusion,0,smoothness;
// Albedo=base_color`, which lists files and the content of their channels. Content is roughness, glossiness,
// smoothness, metallic, occlusion, specular, diffuse or base_color (three channels for a color), or a number
// from 0 to 1. Throws kUsage, with `option`, for unknown words and for a file that does not have 1, 3 or 4
// channels.
Layout layout_from(const std::string& option, const std::string& text);

}  // namespace remap
