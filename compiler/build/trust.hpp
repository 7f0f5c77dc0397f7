// How far a converter of width and specular can be trusted, from the pictures that its table compared.
#pragma once

#include <string>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

// Above this image error, more than a third of the picture is wrong: the two models differ too much for any
// converter.
inline constexpr double kLargestTrustedError = 1.0 / 3.0;

// Whether the fit comes from a table that compares spheres.
bool is_measured(const Fit& fit);

// Returns the RMS image error at the best parameters; infinity if no pictures were compared.
double image_error(const Fit& fit);

// Returns why the converter needs a look before use, `image error above 0.33` or `pictures never compared`;
// empty if it does not. Such converters carry a mark in the report.
std::string trust_warning(const Fit& fit);

// Returns the fits by rising image error; equal ones by id.
std::vector<const Fit*> by_trust(const std::vector<Fit>& fits);

}  // namespace remap
