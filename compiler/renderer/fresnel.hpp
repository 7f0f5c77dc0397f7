// This file computes Fresnel reflectance of smooth boundaries for unpolarised light. It also has equation (1)
// of the paper, which reduces an index of refraction to the reflectance at normal incidence.
#pragma once

#include <complex>

namespace remap {

// Returns F0 = (c - 1)(c* - 1) / ((c + 1)(c* + 1)) for a complex index of refraction c = eta + i k relative
// to the outside (Sztrajman et al. 2019, equation 1). The result is in [0, 1] for eta >= 0, whatever the sign
// of k.
double normal_reflectance(std::complex<double> ior);

// Returns the real index >= 1 whose normal_reflectance is `f0` in [0, 1): (1 + sqrt(f0)) / (1 - sqrt(f0)).
double ior_of_reflectance(double f0);

// A PolarisedReflectance is the reflectance of light polarised in the plane of incidence (p) and
// perpendicular to it (s).
struct PolarisedReflectance {
  double p;
  double s;
  double mean() const { return 0.5 * (p + s); }
};

// Returns the reflectance of a dielectric with relative index `ior` > 0, seen from outside. `cosine` in [0,
// 1] belongs to the angle of incidence (Fresnel 1823). Returns 1 under total reflection, which needs ior < 1.
PolarisedReflectance fresnel_dielectric(double cosine, double ior);

// Returns the reflectance of a conductor with index eta + i k, eta > 0, k >= 0, without approximation (Born
// and Wolf 1999, section 14.2). At k = 0 it equals fresnel_dielectric.
PolarisedReflectance fresnel_conductor(double cosine, double eta, double k);

}  // namespace remap
