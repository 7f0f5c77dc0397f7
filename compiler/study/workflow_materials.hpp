// Materials for the workflows study: random materials from a seed, and measured materials from a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "study/lit_reflectances.hpp"

namespace remap {

enum class MaterialGroup {
  kRandom,    // random colors of diffuse reflectance and F0
  kPlastic,   // colored diffuse, grey F0 of 0.02 to 0.12
  kPaint,     // colored diffuse and colored F0
  kNgan,      // 86 measured materials, fits of Ward's model by Ngan et al. 2005
  kMeasured,  // dielectrics and metals of physicallybased.info, and mixtures of both
};
inline constexpr std::size_t kMaterialGroups = 5;
// `random`, `plastic`, `paint`, `ngan`, `measured`.
std::string group_name(MaterialGroup group);

// A material of the specular workflow; diffuse is a reflectance.
struct StudyMaterial {
  std::string name;
  MaterialGroup group = MaterialGroup::kRandom;
  Reflectances surface;
  std::size_t alpha = 0;  // index into the alphas of the study
};

struct MaterialSetOptions {
  std::filesystem::path folder;  // of ngan_ward.fit and physicallybased.json; empty: no measured materials
  std::size_t group_count = 40;  // materials of each group
  std::size_t alpha_count = 5;   // number of alphas, which the materials of a group use in turn
  std::uint64_t seed = 1;
};

struct MaterialSet {
  std::vector<StudyMaterial> materials;  // grouped by MaterialGroup
  std::vector<std::string> remarks;      // missing groups, one sentence each
};

// Returns a set that depends only on the options. A group whose file is missing is replaced by a remark. If a
// file has fewer materials than requested, they are repeated at other alphas. Throws kInput for a file that
// cannot be parsed, kUsage for counts of 0.
MaterialSet study_materials(const MaterialSetOptions& options);

}  // namespace remap
