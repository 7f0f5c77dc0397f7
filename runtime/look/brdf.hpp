// This file holds the built-in BRDF models, as Mitsuba 0.6 defines them (Jakob 2010; the paper's section 4),
// and the lobes of file formats that store an exponent. Values are reflectance per steradian, without the
// cosine of the light. The list of models has their parameters.
#pragma once

#include <span>
#include <string>

#include "remap/model.hpp"

namespace remap {

// A LocalGeometry holds directions at a surface point, reduced to the cosines that isotropic models need.
struct LocalGeometry {
  double cos_light;       // normal to light, > 0
  double cos_view;        // normal to camera, > 0
  double cos_half;        // normal to the normalised half vector
  double cos_light_half;  // between light and half vector; the view has the same cosine
  double half_length_2;   // |light + view|^2, not normalised
  double cos_mirror;      // mirrored light to view
};

// Returns the geometry from the cosines between normal and light, normal and camera, light and camera. The
// sum of light and camera must not be 0.
LocalGeometry local_geometry(double cos_light, double cos_view, double cos_between);

// A Lobe is the reflectance of one model: `base` + specular * `slope`. Under Schlick's Fresnel (1994), `base`
// is the reflectance at F0 = 0. It is 0 for models whose specular is a plain scale.
struct Lobe {
  double base;
  double slope;
};

enum class Brdf {
  kWard,
  kWardDuer,
  kWardBalanced,
  kPhong,  // normalised to (n + 2) / (2 pi), times the cosine (Lafortune and Willems 1994)
  kBeckmann,
  kGgx,
  kAs,
  kBlinn,  // N.H, normalised to (n + 8) / (8 pi), times the cosine (Akenine-Moller et al. 2008, section 7.6)
  kPlainPhong,  // R.V, neither normalised nor times the cosine (Phong 1975)
  // The lobe is a power of N.H, neither normalised nor times the cosine (Blinn 1977; OpenGL 1.0, section
  // 2.13; MTL, illum 2).
  kPlainBlinn,
};
// Returns the name of the lobe's function in brdf.glsl.
const char* glsl_name(Brdf brdf);

enum class Fresnel { kNone, kSchlick };

// A BrdfModel holds the parts of a built-in model.
struct BrdfModel {
  Brdf brdf = Brdf::kGgx;
  Fresnel fresnel = Fresnel::kSchlick;
  bool operator==(const BrdfModel&) const = default;
};

// Returns the lobe of a perfect mirror: reflectance without Fresnel.
double evaluate_shape(Brdf brdf, double alpha, const LocalGeometry& geometry);

// Returns (1 - cosine)^5, the weight of white in Schlick's Fresnel (1994): F = F0 + (1 - F0) weight.
double schlick_weight(double cosine);

Lobe evaluate_lobe(Brdf brdf, Fresnel fresnel, double alpha, const LocalGeometry& geometry);

// Return the normal distribution of microfacets, normalised to projected area 1, and the Smith shadowing of
// one direction in its separable form (Walter et al. 2007). Both accept kBeckmann, kGgx and kAs.
double microfacet_distribution(Brdf brdf, double alpha, double cos_half);
double smith_shadowing(Brdf brdf, double alpha, double cos_direction);

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
