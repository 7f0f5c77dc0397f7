// The largest fits that are read and written. Each limit is several times what any fit that ships or that a
// regression of remapc finds has, and low enough that showing, emitting and converting by a fit at the limit
// takes seconds.
#pragma once

#include <cstddef>
#include <string>

#include "lower/fit.hpp"

namespace remap {

// Limits of a parametric mapping: powers of specular, powers of alpha, terms of specular.
inline constexpr std::size_t kMostSpecularPowers = 16, kMostAlphaPowers = 32, kMostTerms = 64;
// Gaussians of each output.
inline constexpr std::size_t kMostVectors = 4096;
// Limits of each network.
inline constexpr std::size_t kMostLayers = 6, kMostNetworkNumbers = 20'000;
// The largest alpha and specular of a source. Physical ones end at 1, scales of some models at a few.
inline constexpr double kLargestDomain = 1000.0;

// What of a fit or a network is beyond a limit: `has 5000 support vectors; at most 4096 are possible`. Empty
// if nothing is.
std::string oversize(const Fit& fit);
std::string oversize(const Network& network);

}  // namespace remap
