// This file handles the green channel of normal maps. It reads from a map's name whether green points up
// (OpenGL) or down (DirectX), and makes copies with inverted green.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "texture/image_library.hpp"

namespace remap {

enum class NormalGreen { kUp, kDown };

// Returns the direction that the name of a normal map states, or nothing if the name has none of the words
// OpenGL, DirectX, GL and DX.
std::optional<NormalGreen> stated_green(const std::string& name);
// Returns the name of the same map with the other direction, or `name` if it states none.
std::string turned_name(const std::string& name);

// Returns a finished copy with green replaced by 1 - green, or by -green if values have a sign. The copy does
// not have its name `to` yet. Everything else is copied from `from`. Throws kInput if `from` cannot be read
// or has no green, and kOutput if the copy cannot be written.
std::unique_ptr<NewImage> turned_copy(const std::shared_ptr<const InputFile>& from,
                                      const std::filesystem::path& to);

}  // namespace remap
