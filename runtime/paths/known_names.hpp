// This file lists programs and file formats by the names that people know.
#pragma once

#include <span>
#include <string_view>

#include "core/json.hpp"

namespace remap {

struct KnownName {
  std::string_view title;  // such as `Unreal Engine`
  std::string_view word;   // word for `--from` and `--to`, such as `unreal`
};

// Returns engines, modellers, renderers and texture libraries. Each `word` is an alias or a model.
std::span<const KnownName> known_programs();
std::span<const KnownName> known_formats();
// Returns a list of objects {"title", "name", "model"}.
Json names_json(std::span<const KnownName> names);

}  // namespace remap
