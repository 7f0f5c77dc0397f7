// Whole materials through one conversion: rows of texels of every parameter in, rows of every parameter out.
// What texture passes run; a converter of width and specular alone is one of these.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "convert/converter.hpp"
#include "convert/material_rows.hpp"
#include "warp/warp_fit.hpp"
#include "workflow/workflow_models.hpp"

namespace remap {

class MaterialConverter {
 public:
  virtual ~MaterialConverter() = default;

  // Models, width parameters and ranges of both ends.
  const ConverterInfo& info() const noexcept { return info_; }
  // What it needs, and what it makes, each in the order of Parameter. Where it can diagnose, it may
  // take kMetalMask or kNearbyMetallic as well.
  const std::vector<Parameter>& sources() const noexcept { return sources_; }
  const std::vector<Parameter>& targets() const noexcept { return targets_; }
  bool has_source(Parameter parameter) const noexcept;
  bool has_target(Parameter parameter) const noexcept;
  // Whether it can say kResidual, kMetallicWidth and kDoubts.
  virtual bool can_diagnose() const noexcept { return false; }

  // Rows that it writes for a parameter where the source has `specular_channels` of specular.
  virtual std::size_t target_channels(Parameter parameter, std::size_t specular_channels) const = 0;

  // Converts `count` texels. `in` has all of sources(), colors in one or three rows; of `out` those with
  // rows are written. An output row may be exactly the input row of the same parameter and channel. Widths
  // are the parameters that info() names. Safe to call from many threads. Returns the number of texels
  // outside the domain of the converter of width and specular. `outside`: where not null, a row that gets 1
  // for each of those and 0 for each other.
  virtual std::size_t convert(std::size_t count, const MaterialRows<const float>& in,
                              const MaterialRows<float>& out, std::uint8_t* outside = nullptr) const = 0;

 protected:
  MaterialConverter(ConverterInfo info, std::vector<Parameter> sources, std::vector<Parameter> targets)
      : info_(std::move(info)), sources_(std::move(sources)), targets_(std::move(targets)) {}

 private:
  ConverterInfo info_;
  std::vector<Parameter> sources_, targets_;
};

// Width and specular alone. `converter` must outlive the result.
std::unique_ptr<MaterialConverter> make_material_converter(const Converter& converter);

// What materials of a workflow are made of, in the order of Parameter.
std::vector<Parameter> parameters_of(const WorkflowEnd& end);

// What leads from a material of one workflow to one of another.
struct WorkflowStages {
  WorkflowEnd source, target;
  // Of width and specular, between the BRDFs that both ends stand on; null where they are the same. Must
  // outlive the converter.
  const Converter* brdf = nullptr;
  RoughnessConvention width = RoughnessConvention::kRoughness;  // of both ends where there is no `brdf`
  // To metallic; not used where the target is a specular workflow.
  WorkflowFormula formula = Projection{kCleanPrior};
};

// In one pass over the rows, block by block: a metallic source becomes a specular one by equation (2), width
// and specular go through `brdf`, and the result becomes metallic by `formula` where the target is. Where
// `brdf` changes specular, the diffuse lobe keeps its reflectance: diffuse that is scaled is what remains of
// it beside the new specular. Throws kInput as require_valid() does.
std::unique_ptr<MaterialConverter> make_workflow_converter(const WorkflowStages& stages,
                                                           InstructionSet set = best_instruction_set());

// Diffuse, specular and width of the source of a warp to those of its template, all rows wanted. A metallic
// source becomes a specular one first, by equation (2). Colors in one row stand for grey. Throws kInput as
// require_valid() does.
std::unique_ptr<MaterialConverter> make_warp_converter(const WarpMapFit& fit, const WorkflowEnd& source,
                                                       InstructionSet set = best_instruction_set());

}  // namespace remap
