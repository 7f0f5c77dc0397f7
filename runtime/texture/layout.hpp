// The arrangement of results in files.
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

// A parameter that a conversion makes or takes along, in one channel or, of a color, in three.
struct LayoutParameter {
  Parameter parameter = Parameter::kRoughness;
  std::optional<RoughnessEncoding> width;  // of kRoughness: roughness or glossiness
};
// A parameter that is never converted (`occlusion`).
struct LayoutCarried {
  std::string name;
  float otherwise = 1.0f;  // stored where the set does not have it
};
// Roughness, metallic, ..., occlusion, or a stored value from 0 to 1.
using LayoutContent = std::variant<LayoutParameter, LayoutCarried, float>;

struct LayoutFile {
  std::string name;  // without extension; `*` stands for the name of the set, which comes first without it
  std::vector<LayoutContent> content;  // of 1, 3 or 4 channels
};

struct Layout {
  std::string name;
  bool keeps_names = false;       // each map with a converted channel keeps its name
  std::vector<LayoutFile> files;  // other results have a file each, named as the parameter

  // The encoding of the roughness in its files; none if roughness has a separate file.
  std::optional<RoughnessEncoding> width() const;
  // The file with `parameter`; null for none.
  const LayoutFile* file_with(Parameter parameter) const;
  // Whether a file has a channel for a parameter that is carried, such as `occlusion` or `metallic`.
  bool has_place_for(std::string_view carried) const;
  bool operator==(const Layout& other) const { return name == other.name; }
};

// Each map with a converted channel keeps its name.
Layout as_inputs();
// One file each for roughness, colors and carried parameters.
Layout separate();

// A layout with a name. That of an engine or tool has the maps that it reads, by its documentation
// (docs/presets.md has the links).
struct NamedLayout {
  std::string_view name;
  std::string_view words;   // of `--to` that mean it; `--to gltf` means the material alone
  std::string_view files;   // as layout_from() reads it; empty: separate
  std::string_view format;  // extension; empty for a layout of no engine, and as the inputs
  std::optional<PixelType> type;
  std::optional<NormalGreen> normals;  // how it reads green of normal maps, where its documentation says so
};
// `as-inputs`, `separate`, `orm`, `arm`, `specgloss`; and those of engines: `gltf`, `unity`, `unreal`, ...
std::span<const NamedLayout> named_layouts();
std::span<const NamedLayout> engine_layouts();
// The layout of the engine with that name, or that a word of `--to` means; null for none.
const NamedLayout* engine_layout(std::string_view name);
const NamedLayout* engine_layout_of(std::string_view word);

// A layout by its name, or in words: `MaskMap=metallic,occlusion,0,smoothness; Albedo=base_color`
// lists files and, by channel, what they hold: roughness, glossiness or smoothness, metallic, occlusion,
// specular, diffuse or base_color (three channels each), or a number from 0 to 1. Throws kUsage, naming
// `option`, for unknown words and other numbers of channels than 1, 3 and 4.
Layout layout_from(const std::string& option, const std::string& text);

}  // namespace remap
