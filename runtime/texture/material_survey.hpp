// This file samples the maps of a material before the conversion, to detect conventions that no file states.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "remap/workflow.hpp"
#include "stages/dielectric_f0.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// A MaterialSample holds texels of a grid over the whole picture, without transparent ones. Each parameter
// has one or three rows of linear values, with factors applied. Roughness has the encoding of the maps.
using MaterialSample = std::map<Parameter, std::vector<std::vector<float>>>;

// Samples about 4000 texels in 16 bands of rows. Each map is read once, up to the last band.
MaterialSample sample_materials(TextureSet& set);

// Estimates the F0 of the dielectrics after `stages.brdf`. `stages` lead from a specular to a metallic
// workflow. `width` is the encoding of roughness in the sample. Returns nothing if no texel allows an
// estimate.
std::optional<DielectricF0> estimated_f0(const MaterialSample& sample, const WorkflowStages& stages,
                                         RoughnessEncoding width);

}  // namespace remap
