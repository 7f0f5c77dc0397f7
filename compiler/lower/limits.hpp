// This file limits the fits that are read and written. Each limit is several times the size of any shipped
// fit and of any result of remapc's regressions. It is low enough that showing, emitting and converting by a
// fit at the limit takes seconds.
#pragma once

#include <cstddef>
#include <string>

#include "lower/fit.hpp"

namespace remap {

// These limit a parametric mapping: powers of specular, powers of alpha, terms of specular.
inline constexpr std::size_t kMostSpecularPowers = 16, kMostAlphaPowers = 32, kMostTerms = 64;
// This limits the Gaussians of each output.
inline constexpr std::size_t kMostVectors = 4096;
// These limit each network.
inline constexpr std::size_t kMostLayers = 6, kMostNetworkNumbers = 20'000;
// This limits alpha and specular of a source. Physical values end at 1, scales of some models at less than
// 10.
inline constexpr double kLargestDomain = 1000.0;

// Returns which part of a fit or a network exceeds a limit: `has 5000 support vectors; at most 4096 are
// possible`. Returns an empty text if no part does.
std::string oversize(const Fit& fit);
std::string oversize(const Network& network);

}  // namespace remap
