// The table that `texremap convert --dry-run` shows for a set: a line for each role.
#pragma once

#include <string>
#include <vector>

#include "remap/model.hpp"
#include "texremap/plan/job.hpp"
#include "texture/target_plan.hpp"

namespace remap {

// One role of a set. Empty fields have no meaning there.
struct PlannedRole {
  std::string role;      // `roughness`, `base_color`; empty for files without one
  std::string input;     // `rock_arm.png:G`, `0.04`
  std::string encoding;  // of the input: `srgb`, `linear`, `glossiness`
  std::string happens;   // `converted`, `kept`, `read`, `made`, `carried`, `copied`, `left behind`
  std::string output;    // names of the files that hold it
  bool operator==(const PlannedRole&) const = default;
};

// `own_width` is the encoding of the source where the set does not say one, `width` that of the results.
std::vector<PlannedRole> planned_roles(const TextureSet& set, const TargetPlan& plan,
                                       const TargetChoice& choice, const SetWork& work,
                                       RoughnessEncoding own_width, RoughnessEncoding width);

// The rows in columns, under a heading; every line begins with two spaces.
std::string plan_table(const std::vector<PlannedRole>& roles);

}  // namespace remap
