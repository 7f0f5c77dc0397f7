// This file gives the compiled-in text of generated/converters.json.
#pragma once

#include <string_view>

namespace remap {

std::string_view shipped_text() noexcept;

}  // namespace remap
