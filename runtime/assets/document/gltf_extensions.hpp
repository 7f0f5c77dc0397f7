// This file lists glTF names that material conversions read and write, and groups extensions by effect.
#pragma once

#include <string_view>

namespace remap {

inline constexpr std::string_view kCoreMember = "pbrMetallicRoughness";
inline constexpr std::string_view kSpecGlossExtension = "KHR_materials_pbrSpecularGlossiness",
                                  kSpecularExtension = "KHR_materials_specular",
                                  kIorExtension = "KHR_materials_ior",
                                  kTransmissionExtension = "KHR_materials_transmission",
                                  kUnlitExtension = "KHR_materials_unlit",
                                  kPointerExtension = "KHR_animation_pointer",
                                  kTransformExtension = "KHR_texture_transform";

// Returns true if the extension adds to what core materials reflect or transmit.
bool is_reflecting(std::string_view extension);
// Returns true for KHR_ and EXT_ extensions that are known not to affect materials.
bool is_known_extension(std::string_view extension);
// Returns true if the extension names an image of another format in a texture.
bool is_of_image_format(std::string_view extension);

}  // namespace remap
