// Spheres of the source and of its match side by side, as a display shows them.
#pragma once

#include <string>
#include <vector>

#include "sweep/block_match.hpp"

namespace remapc {

// Widths at which spheres are compared, spread over those of a table.
inline constexpr std::size_t kComparedSpheres = 8;

// Structural similarity of the source's sphere and its match's, by rising width: at up to kComparedSpheres
// widths the usable row whose specular1 is nearest half of the source's range. Under the first light of the
// objective, without diffuse, exposed so that the brightest point of a white diffuse sphere would be white.
std::vector<remap::SphereSimilarity> compare_spheres(const SweepSetup& setup,
                                                     const std::vector<TableRow>& rows);

// As the comment kSpheresComment of a table: `0.1 0.998, 0.5 0.97`, alpha1 and similarity.
std::string spheres_text(const std::vector<remap::SphereSimilarity>& spheres);

}  // namespace remapc
