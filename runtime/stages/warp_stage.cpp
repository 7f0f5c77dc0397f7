#include <algorithm>
#include <array>
#include <memory>

#include "remap/warp.hpp"
#include "remap/workflow.hpp"
#include "stages/kernels.hpp"
#include "stages/packed_warp.hpp"
#include "stages/stage.hpp"

namespace remap {
namespace {

ConverterInfo info_of(const WarpMapFit& fit, InstructionSet set) {
  ConverterInfo info;
  info.id = fit.id;
  info.source = {fit.source_model, RoughnessEncoding::kAlpha, "specular"};
  info.target = {fit.template_model, RoughnessEncoding::kAlpha, "specular"};
  info.roughness = info.specular = {0.0, 1.0};
  info.instructions = set;
  info.steps = {fit.id};
  return info;
}

class WarpStage final : public Stage {
 public:
  WarpStage(const CompiledWarp& warp, InstructionSet set) : warp_(packed(warp)), kernel_(kernels(set).warp) {}

  bool has_domain() const noexcept override { return true; }

  std::size_t run(Block& block, std::uint8_t* outside) const override {
    const auto diffuse = block.color(Parameter::kDiffuse), specular = block.color(Parameter::kSpecular);
    const std::array<const float*, kWarpParameters> in = {diffuse[0],
                                                          diffuse[1],
                                                          diffuse[2],
                                                          specular[0],
                                                          specular[1],
                                                          specular[2],
                                                          block.row(Parameter::kRoughness)};
    if (outside != nullptr) flag_outside(block.size(), in, outside);  // before rows are overwritten
    const auto new_diffuse = block.make_color(Parameter::kDiffuse),
               new_specular = block.make_color(Parameter::kSpecular);
    return kernel_(warp_, block.size(), in,
                   {new_diffuse[0], new_diffuse[1], new_diffuse[2], new_specular[0], new_specular[1],
                    new_specular[2], block.make(Parameter::kRoughness)});
  }

 private:
  // Flags texels with parameters outside 0 to 1, the range of a warp.
  static void flag_outside(std::size_t size, const std::array<const float*, kWarpParameters>& rows,
                           std::uint8_t* outside) {
    for (std::size_t i = 0; i < size; ++i)
      outside[i] =
          !std::ranges::all_of(rows, [i](const float* row) { return row[i] >= 0.0f && row[i] <= 1.0f; });
  }

  PackedWarp warp_;
  decltype(Kernels::warp) kernel_;
};

}  // namespace

std::unique_ptr<Converter> make_warp_converter(const WarpMapFit& fit, const WorkflowEnd& source,
                                               InstructionSet set) {
  require_valid(fit.warp, fit.id);
  StageList stages;
  if (const auto* metallic = std::get_if<MetallicWorkflow>(&source))
    stages.push_back(
        specular_stage(*metallic, DiffuseConvention::kPlain, RoughnessEncoding::kAlpha, set, fit.id));
  stages.push_back(std::make_shared<WarpStage>(fit.warp, set));
  return std::make_unique<Converter>(info_of(fit, set), parameters_of(source),
                                     parameters_of(SpecularWorkflow{}), std::move(stages));
}

}  // namespace remap
