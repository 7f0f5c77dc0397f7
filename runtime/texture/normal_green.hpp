// Green of normal maps: whether it points up (OpenGL) or down (DirectX) by the name of a map, and copies with
// green turned.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "texture/image_library.hpp"

namespace remap {

enum class NormalGreen { kUp, kDown };

// What the name of a normal map says, and the name of the same map with green turned: `wood_nor_gl_4k.png`
// and `wood_nor_dx_4k.png`.
struct StatedGreen {
  NormalGreen green = NormalGreen::kUp;
  std::string turned_name;
};
// Returns none if the name has none of the words OpenGL, DirectX, GL and DX.
std::optional<StatedGreen> stated_green(const std::string& name);

// A finished copy, not yet under its name `to`, whose green is 1 - green; -green where values have a sign.
// All else is that of `from`. Throws kInput if `from` cannot be read or has no green, kOutput if the copy
// cannot be written.
std::unique_ptr<NewImage> turned_copy(const std::shared_ptr<const InputFile>& from,
                                      const std::filesystem::path& to);

}  // namespace remap
