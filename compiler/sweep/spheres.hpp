// Compares spheres of the source and of its match as a display shows them.
#pragma once

#include <string>
#include <vector>

#include "sweep/block_match.hpp"

namespace remapc {

// The number of compared widths, spread over those of a table.
inline constexpr std::size_t kComparedSpheres = 8;

// Returns the structural similarity of the source's sphere and that of its match, by rising width: at up to
// kComparedSpheres widths, for the usable row whose specular1 is nearest half of the source's range. Spheres
// are lit by the first light of the objective, have no diffuse, and are exposed so that the brightest point
// of a white diffuse sphere would be white.
std::vector<remap::SphereSimilarity> compare_spheres(const SweepSetup& setup,
                                                     const std::vector<TableRow>& rows);

// Formats the comment kSpheresComment of a table: `0.1 0.998, 0.5 0.97`, alpha1 and similarity.
std::string spheres_text(const std::vector<remap::SphereSimilarity>& spheres);

}  // namespace remapc
