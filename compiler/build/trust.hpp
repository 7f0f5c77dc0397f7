// This file decides how reliable a converter of width and specular is, from the pictures that its table
// compares.
#pragma once

#include <string>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

// If the image error is larger, more than a third of the picture is wrong, and the models differ too much for
// any converter.
inline constexpr double kLargestTrustedError = 1.0 / 3.0;

// Returns true if the table of the fit compares spheres.
bool is_measured(const Fit& fit);

// Returns the RMS image error at the best parameters. If no pictures were compared, it is infinite.
double image_error(const Fit& fit);

// Returns why the user should check the converter first: `image error above 0.33` or `pictures never
// compared`. Returns an empty text if there is no reason. The report marks such converters.
std::string trust_warning(const Fit& fit);

// Returns the fits sorted by image error, smallest first. Fits with equal errors are sorted by id.
std::vector<const Fit*> by_trust(const std::vector<Fit>& fits);

}  // namespace remap
