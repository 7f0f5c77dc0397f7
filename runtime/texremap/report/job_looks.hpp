// This file shows the materials of a plan's jobs before and after their conversion.
#pragma once

#include <string>
#include <vector>

#include "look/material_looks.hpp"
#include "texremap/plan/convert_plan.hpp"

namespace remap {

class JobLooks {
 public:
  // `before` and `after` are the models of the renderers that show the source and the target. `plan` must
  // outlive this object. Throws like ShownModel.
  explicit JobLooks(const ConvertPlan& plan, const ModelTest& before = is_linear_lobe,
                    const ModelTest& after = is_linear_lobe);

  // Returns notes about what is not shown, and about models that are shown by another model.
  const std::vector<std::string>& notes() const { return notes_; }
  // Returns the name above the copied look.
  std::string copied_title() const;
  // Returns the first `most` materials of a job, with at most about `side` texels a side. A set is one
  // material. Nothing is written. Throws kInput for files that cannot be read or shown.
  std::vector<MaterialLooks> of(const Job& job, int side, std::size_t most) const;

 private:
  MaterialLooks of_set(const Job& job, int side) const;
  std::vector<MaterialLooks> of_asset(const AssetWork& asset, int side, std::size_t most) const;

  const ConvertPlan& plan_;
  const ConverterGraph graph_;
  const ShownModel source_, target_;
  std::vector<std::string> notes_;
};

}  // namespace remap
