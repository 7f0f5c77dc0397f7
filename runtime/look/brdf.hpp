// This file holds the built-in BRDF models, as Mitsuba 0.6 defines them (Jakob 2010; the paper's section 4),
// and the lobes of file formats that store an exponent. Values are reflectance per steradian, without the
// cosine of the light.
#pragma once

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

}  // namespace remap
