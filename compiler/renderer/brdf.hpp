// The BRDF models of the hub, as Mitsuba 0.6 defines them (Jakob 2010; the paper's section 4). Values are
// reflectance per steradian without the cosine of the light.
#pragma once

#include <string>

namespace remapc {

// Directions at a surface point, reduced to the cosines that isotropic models need.
struct LocalGeometry {
  double cos_light;       // normal to light, > 0
  double cos_view;        // normal to camera, > 0
  double cos_half;        // normal to the normalised half vector
  double cos_light_half;  // light to half vector, which is also view to half vector
  double half_length_2;   // |light + view|^2, not normalised
  double cos_mirror;      // mirrored light to view
};

// Reflectance of one model: `base` + specular * `slope`. With Schlick's Fresnel (1994) base is the part that
// stays at F0 = 0; models with a plain scale have none.
struct Lobe {
  double base;
  double slope;
};

enum class Brdf { kWard, kWardDuer, kWardBalanced, kPhong, kBeckmann, kGgx, kAs };
enum class Fresnel { kNone, kSchlick };

// What a model of the built-in renderer is made of.
struct BrdfModel {
  Brdf brdf = Brdf::kGgx;
  Fresnel fresnel = Fresnel::kSchlick;
  bool operator==(const BrdfModel&) const = default;
};

// The built-in model of this name, for those who light it otherwise than by the lights of a Scene. Throws
// kUsage with the nearest known name, and for a model that is neither scaled nor given by F0.
BrdfModel builtin_brdf(const std::string& name);

// A model whose specular map holds a scale or F0: `lobe` where reflectance is linear in it; else `lobe` is of
// a mirror-white surface, and F0 that of a dielectric under exact Fresnel reflectance.
struct MapModel {
  BrdfModel lobe;
  bool is_dielectric = false;
};

// The built-in model of this name for maps, which hold values of 0 to 1: where a model is given by an index,
// its F0. Throws kUsage with the nearest known name, and for conductors, of which F0 does not tell the index.
MapModel builtin_map_model(const std::string& name);

// The lobe of a mirror-white surface: reflectance without Fresnel.
double evaluate_shape(Brdf brdf, double alpha, const LocalGeometry& geometry);

Lobe evaluate_lobe(Brdf brdf, Fresnel fresnel, double alpha, const LocalGeometry& geometry);

// Normal distribution of microfacets with projected area 1, and separable Smith shadowing for one direction
// (Walter et al. 2007). For kBeckmann, kGgx, kAs.
double microfacet_distribution(Brdf brdf, double alpha, double cos_half);
double smith_shadowing(Brdf brdf, double alpha, double cos_direction);

}  // namespace remapc
