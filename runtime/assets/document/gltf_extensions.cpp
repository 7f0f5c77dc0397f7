#include "assets/document/gltf_extensions.hpp"

#include <algorithm>
#include <array>

#include "core/contains.hpp"
namespace remap {
namespace {

constexpr std::array<std::string_view, 10> kReflecting = {
    "KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion", "KHR_materials_ior",       "KHR_materials_iridescence",
    "KHR_materials_sheen",      "KHR_materials_specular",  "KHR_materials_transmission",
    "KHR_materials_volume"};

constexpr std::array<std::string_view, 4> kOfImageFormats = {"EXT_texture_avif", "EXT_texture_webp",
                                                             "KHR_texture_basisu", "MSFT_texture_dds"};

constexpr std::array<std::string_view, 19> kOthers = {"EXT_lights_image_based",
                                                      "EXT_lights_ies",
                                                      "EXT_mesh_gpu_instancing",
                                                      "EXT_mesh_manifold",
                                                      "EXT_meshopt_compression",
                                                      "KHR_accessor_float64",
                                                      "KHR_animation_pointer",
                                                      "KHR_draco_mesh_compression",
                                                      "KHR_lights_punctual",
                                                      "KHR_materials_emissive_strength",
                                                      "KHR_materials_pbrSpecularGlossiness",
                                                      "KHR_materials_unlit",
                                                      "KHR_materials_variants",
                                                      "KHR_mesh_quantization",
                                                      "KHR_meshopt_compression",
                                                      "KHR_node_visibility",
                                                      "KHR_texture_transform",
                                                      "KHR_xmp_json_ld",
                                                      "MSFT_lod"};

}  // namespace

bool is_reflecting(std::string_view extension) { return contains(kReflecting, extension); }

bool is_of_image_format(std::string_view extension) { return contains(kOfImageFormats, extension); }

bool is_known_extension(std::string_view extension) {
  return contains(kOthers, extension) || is_reflecting(extension) || is_of_image_format(extension);
}

}  // namespace remap
