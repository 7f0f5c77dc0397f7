// This file makes the table that `texremap convert --dry-run` shows for a set, with a line for each role.
#pragma once

#include <string>
#include <vector>

#include "remap/model.hpp"
#include "texremap/plan/job.hpp"
#include "texture/target_plan.hpp"

namespace remap {

// A PlannedRole is one role of a set. Fields that do not apply are empty.
struct PlannedRole {
  std::string role;      // `roughness`, `base_color`; empty for files without one
  std::string input;     // `rock_arm.png:G`, `0.04`
  std::string encoding;  // encoding of the input: `srgb`, `linear`, `glossiness`
  std::string happens;   // `converted`, `kept`, `read`, `made`, `carried`, `copied`, `left behind`
  std::string output;    // names of the results that hold the role
  bool operator==(const PlannedRole&) const = default;
};

// `own_width` is the encoding of the source if the set does not state one. `width` is the encoding of the
// results.
std::vector<PlannedRole> planned_roles(const TextureSet& set, const TargetPlan& plan,
                                       const TargetChoice& choice, const SetWork& work,
                                       RoughnessEncoding own_width, RoughnessEncoding width);

// Returns the rows in columns, under a heading. Every line begins with two spaces.
std::string plan_table(const std::vector<PlannedRole>& roles);

}  // namespace remap
