#include <algorithm>

#include "remap/converter.hpp"
#include "remap/model.hpp"

namespace remap {
namespace {

constexpr NamedValues<Parameter, kParameterCount> kParameters = {
    {{Parameter::kRoughness, "width"},
     {Parameter::kSpecular, "specular"},
     {Parameter::kDiffuse, "diffuse"},
     {Parameter::kBaseColor, "base_color"},
     {Parameter::kMetallic, "metallic"},
     {Parameter::kMetalMask, "metal_mask"},
     {Parameter::kResidual, "residual"},
     {Parameter::kMetallicUncertainty, "metallic_uncertainty"},
     {Parameter::kMetallicIssues, "issues"}}};

}  // namespace

std::string_view parameter_name(Parameter parameter) { return name_of(kParameters, parameter); }

bool is_measure(Parameter parameter) {
  return parameter == Parameter::kResidual || parameter == Parameter::kMetallicUncertainty ||
         parameter == Parameter::kMetallicIssues;
}

std::string plain_name(Parameter parameter) {
  return parameter == Parameter::kRoughness ? "roughness" : std::string(parameter_name(parameter));
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

}  // namespace remap
