// The least error of the study of environments: how alike two models can be made to look under given
// environments by any conversion of parameters.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "report/radiance_pyramid.hpp"
#include "study/environments_options.hpp"

namespace remapc {

// Pixel rows of the pictures that the search compares, and the progress that it reports for each alpha.
inline constexpr int kLeastErrorResolution = 48;

// For each of `starts` (all of one source alpha) the target parameters of least mean RMSE over the
// environments: the best specular at each of eleven widths around that of the start, a parabola through the
// best three. Where the best width lies within a factor of 1.5 of the start, its RMSE is found to about a
// hundredth.
std::vector<Conversion> best_conversions(const EnvironmentsOptions& options, const RadiancePyramid& pyramid,
                                         std::span<const Conversion> starts);

}  // namespace remapc
