// Programs and file formats by the names that people know.
#pragma once

#include <span>
#include <string_view>

#include "core/json.hpp"

namespace remap {

struct KnownName {
  std::string_view title;  // `Unreal Engine`
  std::string_view word;   // of `--from` and `--to`: `unreal`
};

// Engines, modellers, renderers and libraries of textures. Their words are aliases or models.
std::span<const KnownName> known_programs();
std::span<const KnownName> known_formats();
// A list of objects {"title", "name", "model"}.
Json names_json(std::span<const KnownName> names);

}  // namespace remap
