#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "convert/warp_kernel.hpp"
#include "convert/workflow_kernel.hpp"
#include "remap/warp.hpp"
#include "remap/workflow.hpp"

namespace remap {
namespace {

ConverterInfo info_of(const WarpMapFit& fit, InstructionSet set) {
  ConverterInfo info;
  info.id = fit.id;
  info.source = {fit.source_model, RoughnessConvention::kAlpha, "specular"};
  info.target = {fit.template_model, RoughnessConvention::kAlpha, "specular"};
  info.roughness = info.specular = {0.0, 1.0};
  info.instructions = set;
  info.steps = {fit.id};
  return info;
}

// Texels converted by both stages before the next.
constexpr std::size_t kBlock = 1024;
using Block = std::array<std::array<float, kBlock>, kWarpParameters>;

// Grey stands for three equal channels.
void set_color(const ParameterRows<const float>& rows, std::size_t start, const float** color) {
  for (std::size_t c = 0; c < 3; ++c) color[c] = rows.row[rows.count == 1 ? 0 : c] + start;
}

class WarpConverter final : public Converter {
 public:
  WarpConverter(const WarpMapFit& fit, const WorkflowEnd& source, InstructionSet set)
      : Converter(info_of(fit, set), parameters_of(source), parameters_of(SpecularWorkflow{})),
        warp_(packed(fit.warp)),
        kernel_(warp_kernel(set)),
        workflows_(workflow_kernels(set)) {
    const auto* metallic = std::get_if<MetallicWorkflow>(&source);
    if (metallic == nullptr) return;
    to_specular_.emplace();
    to_specular_->metallic = *metallic;
    to_specular_->formula = Equation2{};
    // The width goes by as it is; alpha, as what neither end changes.
    to_specular_->specular.width = to_specular_->metallic.width = RoughnessConvention::kAlpha;
    require_valid(*to_specular_, fit.id);
  }

  std::size_t convert_rows(std::size_t count, const MaterialRows<const float>& in,
                           const MaterialRows<float>& out, std::uint8_t* outside) const override {
    const auto block = to_specular_ ? std::make_unique<Block>() : nullptr;
    std::size_t outside_count = 0;
    for (std::size_t start = 0; start < count; start += kBlock) {
      const std::size_t size = std::min(kBlock, count - start);
      const auto rows = source_rows(size, start, in, block.get());
      if (outside != nullptr) flag_outside(size, rows, outside + start);  // before rows are written over
      outside_count += kernel_(warp_, size, rows, target_rows(start, out));
    }
    return outside_count;
  }

 private:
  // Parameters of a warp lie in 0 to 1.
  static void flag_outside(std::size_t size, const std::array<const float*, kWarpParameters>& rows,
                           std::uint8_t* outside) {
    for (std::size_t i = 0; i < size; ++i)
      outside[i] = !std::all_of(rows.begin(), rows.end(),
                                [i](const float* row) { return row[i] >= 0.0f && row[i] <= 1.0f; });
  }

  std::array<const float*, kWarpParameters> source_rows(std::size_t size, std::size_t start,
                                                        const MaterialRows<const float>& in,
                                                        Block* block) const {
    std::array<const float*, kWarpParameters> rows{};
    const float* const width = in[Parameter::kWidth].row[0] + start;
    if (!to_specular_) {
      set_color(in[Parameter::kDiffuse], start, &rows[0]);
      set_color(in[Parameter::kSpecular], start, &rows[3]);
      rows[6] = width;
      return rows;
    }
    MetallicRows<const float> metallic{};
    set_color(in[Parameter::kBaseColor], start, &metallic[0]);
    metallic[3] = in[Parameter::kMetallic].row[0] + start;
    metallic[4] = width;
    SpecularRows<float> specular{};
    for (std::size_t r = 0; r < rows.size(); ++r) rows[r] = specular[r] = (*block)[r].data();
    workflows_.to_specular(*to_specular_, size, metallic, specular);
    return rows;
  }

  static std::array<float*, kWarpParameters> target_rows(std::size_t start, const MaterialRows<float>& out) {
    std::array<float*, kWarpParameters> rows{};
    for (std::size_t c = 0; c < 3; ++c) {
      rows[c] = out[Parameter::kDiffuse].row[c] + start;
      rows[3 + c] = out[Parameter::kSpecular].row[c] + start;
    }
    rows[6] = out[Parameter::kWidth].row[0] + start;
    return rows;
  }

  PackedWarp warp_;
  WarpKernel kernel_;
  std::optional<WorkflowConversion> to_specular_;
  const WorkflowKernels& workflows_;
};

}  // namespace

std::unique_ptr<Converter> make_warp_converter(const WarpMapFit& fit, const WorkflowEnd& source,
                                               InstructionSet set) {
  require_valid(fit.warp, fit.id);
  return std::make_unique<WarpConverter>(fit, source, set);
}

}  // namespace remap
