// This file detects the program that wrote an MTL file. Some programs give statements another meaning than
// the specification.
#pragma once

#include <string>

#include "assets/document/mtl_document.hpp"
#include "remap/model.hpp"

namespace remap {

enum class MtlMaker {
  kText,       // unknown; statements mean what the specification says (Alias|Wavefront 1995)
  kBlender,    // Blender 3.4 and later: Ns is 1000 (1 - roughness)^2
  kBlender28,  // Blender 2.8 to 3.3: Ns is 900 (1 - roughness)^2
  kNvdiffrec,  // `bsdf pbr`: map_Ks holds roughness in green and metallic in blue (Munkberg et al. 2022)
};
inline constexpr NamedValues<MtlMaker, 4> kMtlMakers = {{{MtlMaker::kText, "mtl"},
                                                         {MtlMaker::kBlender, "blender"},
                                                         {MtlMaker::kBlender28, "blender-2.8"},
                                                         {MtlMaker::kNvdiffrec, "nvdiffrec"}}};

// Returns the maker that the first comments name, or whose special statements occur. Otherwise, returns
// kText. Also returns kText for Blender 2.7, which wrote the exponents of its Blinn and Phong shaders, as the
// specification describes them.
MtlMaker maker_of(const MtlDocument& document);

// Returns a warning that the file is read as this maker writes it: `was written by Blender: ...`. Returns
// nothing for kText.
std::string maker_warning(MtlMaker maker);

// Returns the Ns that Blender writes for roughness 0.
double blender_scale(MtlMaker maker);

}  // namespace remap
