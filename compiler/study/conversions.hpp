// The target materials that each method of the environments study computes, and the best ones: those with the
// pictures most similar to the source's under given environments, which no conversion of parameters can
// exceed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/radiance_pyramid.hpp"
#include "study/environments_options.hpp"

namespace remapc {

// Returns every pair and alpha converted by every method that applies to the pair, sorted by alpha, pair and
// method. Adds a remark for each pair without a fit in `options.fits`.
std::vector<Conversion> conversions_of(const EnvironmentsOptions& options, std::vector<std::string>* remarks);

// The height of the pictures that the search compares, which is also its number of progress calls per alpha.
inline constexpr int kLeastErrorResolution = 48;

// Returns the target parameters of least mean RMSE over the environments for each of `starts`, which have one
// source alpha. Searches for the best specular at each of eleven alphas around the start and interpolates by
// a parabola through the best three. If the best alpha is within a factor of 1.5 of the start, the RMSE is
// accurate to about 1 %.
std::vector<Conversion> best_conversions(const EnvironmentsOptions& options, const RadiancePyramid& pyramid,
                                         std::span<const Conversion> starts);

}  // namespace remapc
