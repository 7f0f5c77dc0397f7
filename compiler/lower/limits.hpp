// This file limits the fits that remapc reads and writes. Each limit is several times as large as any fit
// that remap ships or finds. A fit at the limits can still be shown, emitted and applied in a few seconds.
#pragma once

#include <cstddef>
#include <string>

#include "lower/fit.hpp"

namespace remap {

// These limit a parametric mapping: powers of specular, powers of alpha, and terms of specular.
inline constexpr std::size_t kMostSpecularPowers = 16, kMostAlphaPowers = 32, kMostTerms = 64;
// This limits the number of Gaussians for each output.
inline constexpr std::size_t kMostVectors = 4096;
// These limit every network.
inline constexpr std::size_t kMostLayers = 6, kMostNetworkNumbers = 20'000;
// This limits alpha and specular of a source. Physical values are at most 1, and scales of some models are
// below 10.
inline constexpr double kLargestDomain = 1000.0;

// Returns which part of a fit or a network exceeds a limit: `has 5000 support vectors; at most 4096 are
// possible`. Returns an empty text if no part does.
std::string oversize(const Fit& fit);
std::string oversize(const Network& network);

}  // namespace remap
