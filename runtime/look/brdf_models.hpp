// This file lists the models of the built-in renderer: the BRDF models of brdf.hpp with the parameters that
// they have.
#pragma once

#include <span>
#include <string>

#include "look/brdf.hpp"
#include "remap/model.hpp"

namespace remap {

// A Reflectance decides what the parameters other than width and diffuse mean for the lobe.
enum class Reflectance {
  kScale,         // `specular`, 0 to 1
  kTrimmedScale,  // `specular`, 0 to 2, clamped to 1 so that energy is conserved
  kSchlick,       // `f0`, with Schlick's Fresnel
  kSchlickIor,    // `ior`: Schlick's Fresnel with F0 from equation (1) of the paper
  kDielectric,    // `ior`: exact Fresnel of a dielectric
  kConductor,     // `eta`, `k`: exact Fresnel of a conductor
  kMetallic,  // `base_color`, `metallic`, `specular`: diffuse and Schlick's F0 by equation (2) of the paper
};

// A BuiltinModel is a model of the built-in renderer. `alpha` is the range of widths that it accepts.
struct BuiltinModel {
  const char* name;
  Brdf brdf;
  Reflectance reflectance;
  RoughnessEncoding roughness;
  Range alpha;
};

std::span<const BuiltinModel> builtin_models();

// Returns null for an unknown name.
const BuiltinModel* find_builtin_model(const std::string& name);

// Returns the built-in model `name`, for callers whose lights are not in a Scene. Throws kUsage for an
// unknown name (with the closest), and for a model whose specular is neither a scale nor F0.
BrdfModel builtin_brdf(const std::string& name);

// Returns true if builtin_brdf() knows the model and its specular is a scale or F0.
bool is_linear_lobe(const std::string& name);

// A MapModel is a model whose specular map holds a scale or F0. `lobe` is the model itself if reflectance is
// linear in that value. Otherwise `lobe` is a perfect mirror's lobe, to be multiplied by the exact Fresnel
// reflectance of a dielectric with the map's F0.
struct MapModel {
  BrdfModel lobe;
  bool is_dielectric = false;
};

// Returns the built-in model `name` for maps with values of 0 to 1. For a model with an index of refraction,
// the map holds F0. Throws kUsage for an unknown name (with the closest), and for conductors, because F0 does
// not determine their index.
MapModel builtin_map_model(const std::string& name);

}  // namespace remap
