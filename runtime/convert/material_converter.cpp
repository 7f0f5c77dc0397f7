#include "convert/material_converter.hpp"

#include <algorithm>
#include <array>

#include "text/named_values.hpp"

namespace remap {
namespace {

constexpr NamedValues<Parameter, kParameterCount> kParameters = {
    {{Parameter::kWidth, "width"},
     {Parameter::kSpecular, "specular"},
     {Parameter::kDiffuse, "diffuse"},
     {Parameter::kBaseColor, "base_color"},
     {Parameter::kMetallic, "metallic"},
     {Parameter::kMetalMask, "metal_mask"},
     {Parameter::kNearbyMetallic, "nearby_metallic"},
     {Parameter::kResidual, "residual"},
     {Parameter::kMetallicWidth, "metallic_width"},
     {Parameter::kDoubts, "doubts"}}};

class WidthSpecularConverter final : public MaterialConverter {
 public:
  explicit WidthSpecularConverter(const Converter& converter)
      : MaterialConverter(converter.info(), {Parameter::kWidth, Parameter::kSpecular},
                          {Parameter::kWidth, Parameter::kSpecular}),
        converter_(converter) {}

  std::size_t target_channels(Parameter parameter, std::size_t specular_channels) const override {
    return parameter == Parameter::kSpecular ? specular_channels : 1;
  }

  std::size_t convert(std::size_t count, const MaterialRows<const float>& in, const MaterialRows<float>& out,
                      std::uint8_t* outside) const override {
    const auto& specular = in[Parameter::kSpecular];
    const auto& specular_out = out[Parameter::kSpecular];
    return converter_.convert(count, in[Parameter::kWidth].row[0], {specular.row.data(), specular.count},
                              out[Parameter::kWidth].row[0], {specular_out.row.data(), specular.count},
                              outside);
  }

 private:
  const Converter& converter_;
};

}  // namespace

std::string_view parameter_name(Parameter parameter) { return name_of(kParameters, parameter); }

bool is_measure(Parameter parameter) {
  return parameter == Parameter::kResidual || parameter == Parameter::kMetallicWidth ||
         parameter == Parameter::kDoubts;
}

std::string plain_name(Parameter parameter) {
  return parameter == Parameter::kWidth ? "roughness" : std::string(parameter_name(parameter));
}

std::string parameter_option(Parameter parameter) {
  std::string option = "--" + plain_name(parameter);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

bool is_color(Parameter parameter) {
  return parameter == Parameter::kSpecular || parameter == Parameter::kDiffuse ||
         parameter == Parameter::kBaseColor;
}

std::vector<Parameter> parameters_of(const WorkflowEnd& end) {
  if (kind_of(end) == WorkflowKind::kSpecular)
    return {Parameter::kWidth, Parameter::kSpecular, Parameter::kDiffuse};
  return {Parameter::kWidth, Parameter::kBaseColor, Parameter::kMetallic};
}

bool MaterialConverter::has_source(Parameter parameter) const noexcept {
  return std::find(sources_.begin(), sources_.end(), parameter) != sources_.end();
}

bool MaterialConverter::has_target(Parameter parameter) const noexcept {
  return std::find(targets_.begin(), targets_.end(), parameter) != targets_.end();
}

std::unique_ptr<MaterialConverter> make_material_converter(const Converter& converter) {
  return std::make_unique<WidthSpecularConverter>(converter);
}

}  // namespace remap
