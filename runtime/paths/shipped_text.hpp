// generated/converters.json, compiled in.
#pragma once

#include <string_view>

namespace remap {

std::string_view shipped_text() noexcept;

}  // namespace remap
