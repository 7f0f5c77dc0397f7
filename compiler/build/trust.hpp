// This file judges how reliable a converter of width and specular is, from its table's pictures.
#pragma once

#include <string>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

// Above this image error, more than a third of the picture is wrong. The models differ too much for any
// converter.
inline constexpr double kLargestTrustedError = 1.0 / 3.0;

// Returns true if the fit comes from a table that compares spheres.
bool is_measured(const Fit& fit);

// Returns the RMS image error at the best parameters, or infinity if no pictures were compared.
double image_error(const Fit& fit);

// Returns why the user should check the converter first: `image error above 0.33` or `pictures never
// compared`. Returns an empty text if there is no reason. The report marks such converters.
std::string trust_warning(const Fit& fit);

// Returns the fits sorted by image error, smallest first. Fits with equal errors are sorted by id.
std::vector<const Fit*> by_trust(const std::vector<Fit>& fits);

}  // namespace remap
