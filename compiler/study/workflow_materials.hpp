// Materials for the study of workflows: random ones of a seed, and measured ones where a folder has them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "study/lit_reflectances.hpp"

namespace remapc {

enum class MaterialGroup {
  kRandom,    // any colors of diffuse reflectance and F0
  kPlastic,   // colored diffuse, grey F0 of 0.02 to 0.12
  kPaint,     // colored diffuse under a specular color of its own
  kNgan,      // 86 measured materials as Ngan et al. 2005 fitted Ward's model to them
  kMeasured,  // dielectrics and metals of physicallybased.info, and mixtures of one of each
};
inline constexpr std::size_t kMaterialGroups = 5;
// `random`, `plastic`, `paint`, `ngan`, `measured`.
std::string group_name(MaterialGroup group);

// Of the specular workflow, diffuse as reflectance.
struct StudyMaterial {
  std::string name;
  MaterialGroup group = MaterialGroup::kRandom;
  Reflectances surface;
  std::size_t alpha = 0;  // index into the widths of the study
};

struct MaterialSetOptions {
  std::filesystem::path folder;  // with ngan_ward.fit and physicallybased.json; empty: no measured materials
  std::size_t group_count = 40;  // materials of each group
  std::size_t alpha_count = 5;   // widths, which the materials of a group take in turn
  std::uint64_t seed = 1;
};

struct MaterialSet {
  std::vector<StudyMaterial> materials;  // group by group
  std::vector<std::string> remarks;      // what was left out, a sentence each
};

// The same set for the same options everywhere. A group whose file is missing is left out, with a remark; a
// file with fewer materials than asked for gives each again at other widths. Throws kInput for a file that
// cannot be understood, kUsage for counts of 0.
MaterialSet study_materials(const MaterialSetOptions& options);

}  // namespace remapc
