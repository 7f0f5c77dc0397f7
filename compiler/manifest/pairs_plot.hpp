// Draws the measured converters of a folder as small multiples.
#pragma once

#include <string>
#include <vector>

#include "remap/fit.hpp"

namespace remapc {

// Returns an SVG with a panel for each measured pair: target alpha over source alpha, and the ratio of
// speculars, at specular 0.5 or at the edge of the domain if that is lower. Pairs of the hub form a matrix, a
// row for each source and a column for each target; the others follow. The hub holds models with measured
// converters to or from more than one other, and pairs without further partners. The same fits give the same
// bytes on every machine.
std::string pairs_plot(const std::vector<remap::Fit>& fits);

}  // namespace remapc
