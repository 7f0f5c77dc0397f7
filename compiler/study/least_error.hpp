// The least error of the environments study: the best agreement of two models under given environments that
// any conversion of parameters can reach.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "report/radiance_pyramid.hpp"
#include "study/environments_options.hpp"

namespace remapc {

// The height of the pictures that the search compares, which is also its number of progress calls per alpha.
inline constexpr int kLeastErrorResolution = 48;

// Returns the target parameters of least mean RMSE over the environments for each of `starts`, which have one
// source alpha. Searches for the best specular at each of eleven alphas around the start and interpolates by
// a parabola through the best three. If the best alpha is within a factor of 1.5 of the start, the RMSE is
// accurate to about 1 %.
std::vector<Conversion> best_conversions(const EnvironmentsOptions& options, const RadiancePyramid& pyramid,
                                         std::span<const Conversion> starts);

}  // namespace remapc
