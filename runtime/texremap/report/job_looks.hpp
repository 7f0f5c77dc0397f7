// This file shows the materials of a plan's jobs before and after their conversion.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "look/material_looks.hpp"
#include "texremap/plan/convert_plan.hpp"

namespace remap {

// A ShownEnds holds the models of both ends of a conversion of texture sets, as balls show them.
struct ShownEnds {
  ShownModel source, target;
};

class JobLooks {
 public:
  // `plan` must outlive this object. Throws like ShownModel.
  explicit JobLooks(const ConvertPlan& plan);

  // Returns notes about what is not shown, and about models that another model stands for.
  const std::vector<std::string>& notes() const { return notes_; }
  // Returns the name above the copied look.
  std::string copied_title() const;
  // Return the built-in models that show the source and the target.
  std::string source_model() const { return ends_ ? ends_->source.name() : "mitsuba/ggx"; }
  std::string target_model() const { return ends_ ? ends_->target.name() : "mitsuba/ggx"; }
  // Returns the first `most` materials of a job, with at most about `side` texels a side. A set is one
  // material. Nothing is written. Throws kInput for files that cannot be read or shown.
  std::vector<MaterialLooks> of(const Job& job, int side, std::size_t most) const;

 private:
  MaterialLooks of_set(const Job& job, int side) const;
  std::vector<MaterialLooks> of_asset(const AssetWork& asset, int side, std::size_t most) const;

  const ConvertPlan& plan_;
  std::optional<ShownEnds> ends_;  // none for assets, whose materials have one model
  std::vector<std::string> notes_;
};

}  // namespace remap
