// A look at the maps of a material before they are converted: a grid of texels, and what they betray of
// conventions that no file states.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "convert/material_converter.hpp"
#include "texture/texture_set.hpp"
#include "workflow/diagnosis.hpp"

namespace remap {

// Texels of a grid over the whole picture, without those that coverage takes out: for each parameter one row
// or three, linear, with factors, the width in the convention of the maps.
struct MaterialSample {
  std::size_t texel_count = 0;
  std::map<Parameter, std::vector<std::vector<float>>> rows;
};

// Some 4000 texels of 16 bands of rows. Each map is read once, up to the last band.
MaterialSample sample_materials(TextureSet& set);

// What a person should know, one message each: color that looks as if it were read in the wrong color
// space, and maps that are black or white everywhere and cannot be meant so.
std::vector<std::string> doubts_about(const MaterialSample& sample, const TextureSet& set);

// The F0 that dielectrics were made with, where `stages` lead from a specular to a metallic workflow: after
// the width and the specular have gone through `stages.brdf`. `width`: what the sample's are. None where no
// texel tells.
std::optional<DielectricF0> estimated_f0(const MaterialSample& sample, const WorkflowStages& stages,
                                         RoughnessConvention width);

}  // namespace remap
