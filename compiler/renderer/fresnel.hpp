// Fresnel reflectance of smooth boundaries for unpolarised light, and equation (1) of the paper, which
// reduces an index of refraction to the reflectance at normal incidence.
#pragma once

#include <complex>

namespace remapc {

// F0 = (c - 1)(c* - 1) / ((c + 1)(c* + 1)) of a complex index of refraction c = eta + i k relative to the
// outside (Sztrajman et al. 2019, equation 1); in [0, 1] for eta >= 0. The sign of k does not matter.
double normal_reflectance(std::complex<double> ior);

// The real index >= 1 whose normal_reflectance is `f0` in [0, 1): (1 + sqrt(f0)) / (1 - sqrt(f0)).
double ior_of_reflectance(double f0);

// Reflectance for light polarised in the plane of incidence (p) and across it (s).
struct PolarisedReflectance {
  double p;
  double s;
  double mean() const { return 0.5 * (p + s); }
};

// A dielectric of relative index `ior` > 0 seen from outside under `cosine` in [0, 1] (Fresnel 1823). 1 where
// all light is reflected (ior < 1).
PolarisedReflectance fresnel_dielectric(double cosine, double ior);

// A conductor of index eta + i k, eta > 0, k >= 0 (Born and Wolf 1999, section 14.2; no approximation).
// With k = 0 it is a dielectric.
PolarisedReflectance fresnel_conductor(double cosine, double eta, double k);

// Schlick's weight of white, (1 - cosine)^5 (Schlick 1994): F = F0 + (1 - F0) weight.
double schlick_weight(double cosine);

}  // namespace remapc
