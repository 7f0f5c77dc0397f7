#pragma once

namespace remap {

inline constexpr const char* kProgram = "texremap";  // begins every message

}  // namespace remap
