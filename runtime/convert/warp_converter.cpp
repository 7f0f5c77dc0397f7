// Materials by a compiled warp: diffuse, specular and alpha of the source to those of the template.
#include <algorithm>
#include <array>

#include "convert/material_converter.hpp"
#include "convert/warp_kernel.hpp"
#include "model/warp_fit.hpp"

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

class WarpConverter final : public MaterialConverter {
 public:
  WarpConverter(const WarpMapFit& fit, InstructionSet set)
      : MaterialConverter(info_of(fit, set), parameters(), parameters()),
        warp_(packed(fit.warp)),
        kernel_(warp_kernel(set)) {}

  std::size_t target_channels(Parameter parameter, std::size_t) const override {
    return is_color(parameter) ? 3 : 1;
  }

  std::size_t convert(std::size_t count, const MaterialRows<const float>& in,
                      const MaterialRows<float>& out) const override {
    std::array<const float*, kWarpParameters> from{};
    for (std::size_t c = 0; c < 3; ++c) {
      from[c] = row(in[Parameter::kDiffuse], c);
      from[3 + c] = row(in[Parameter::kSpecular], c);
    }
    from[6] = in[Parameter::kWidth].row[0];
    std::array<float*, kWarpParameters> to{};
    for (std::size_t c = 0; c < 3; ++c) {
      to[c] = out[Parameter::kDiffuse].row[c];
      to[3 + c] = out[Parameter::kSpecular].row[c];
    }
    to[6] = out[Parameter::kWidth].row[0];
    return kernel_(warp_, count, from, to);
  }

 private:
  static std::vector<Parameter> parameters() {
    return {Parameter::kWidth, Parameter::kSpecular, Parameter::kDiffuse};
  }
  // Grey stands for three equal channels.
  static const float* row(const ParameterRows<const float>& rows, std::size_t channel) {
    return rows.row[rows.count == 1 ? 0 : channel];
  }

  PackedWarp warp_;
  WarpKernel kernel_;
};

}  // namespace

std::unique_ptr<MaterialConverter> make_warp_converter(const WarpMapFit& fit, InstructionSet set) {
  require_valid(fit.warp, fit.id);
  return std::make_unique<WarpConverter>(fit, set);
}

}  // namespace remap
