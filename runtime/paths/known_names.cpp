#include "paths/known_names.hpp"

#include <array>
#include <string>

#include "remap/conversion.hpp"

namespace remap {
namespace {

constexpr std::array<KnownName, 18> kPrograms = {{
    {"Arnold", "arnold"},
    {"Babylon.js", "babylon"},
    {"Blender", "blender"},
    {"Cycles 5", "cycles-5"},
    {"Filament", "filament"},
    {"Godot", "godot"},
    {"Marmoset Toolbag", "marmoset"},
    {"MuJoCo", "mujoco"},
    {"PlayCanvas", "playcanvas"},
    {"Poly Haven, ambientCG, Quixel", "metal-rough"},
    {"POV-Ray", "povray"},
    {"Radiance", "radiance"},
    {"Substance 3D", "substance"},
    {"three.js", "threejs"},
    {"Unity", "unity"},
    {"Unity, HDRP", "unity-hdrp"},
    {"Unity, specular setup", "unity-specular"},
    {"Unreal Engine", "unreal"},
}};

constexpr std::array<KnownName, 7> kFormats = {{
    {"glTF", "gltf"},
    {"glTF, specular-glossiness", "gltf-specgloss"},
    {"MaterialX standard_surface", "standard-surface"},
    {"OBJ and MTL", "mtl"},
    {"OpenPBR", "openpbr"},
    {"USD", "usd"},
    {"USD, specular workflow", "usd-specular"},
}};

}  // namespace

std::span<const KnownName> known_programs() { return kPrograms; }
std::span<const KnownName> known_formats() { return kFormats; }

Json names_json(std::span<const KnownName> names) {
  Json list = Json::list();
  for (const auto& [title, word] : names)
    list.push_back({{"title", title}, {"name", word}, {"model", model_named(std::string(word)).name}});
  return list;
}

}  // namespace remap
