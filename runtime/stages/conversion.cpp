#include "stages/conversion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "remap/error.hpp"
#include "stages/conversion_constants.hpp"
#include "stages/network_outputs.hpp"

namespace remap {
namespace {

namespace code = workflow_code;

template <std::size_t Count, typename Pointer>
std::array<Pointer, Count> rows(std::span<const Pointer> given, const char* what) {
  if (given.size() != Count)
    throw Error(ErrorKind::kUsage, std::string("workflow conversion: ") + std::to_string(given.size()) +
                                       " rows of " + what + " (give " + std::to_string(Count) + ")");
  std::array<Pointer, Count> all{};
  std::copy(given.begin(), given.end(), all.begin());
  return all;
}

// Interprets a network in double precision, texel by texel.
std::size_t interpret(const Network& network, const code::Conventions& use,
                      const std::array<const float*, 7>& in, const std::array<float*, 5>& out) {
  code::ClampedBlock<7, code::kMetallicBlock> block;
  const std::size_t outside = code::hold(in, block, std::make_index_sequence<7>());
  for (std::size_t i = 0; i < code::kMetallicBlock; ++i) {
    std::vector<double> values;
    bool is_nan = false;
    for (std::size_t r = 0; r < 6; ++r) {
      values.push_back(static_cast<double>(block.row[r][i]));
      is_nan = is_nan || std::isnan(block.row[r][i]);
    }
    const std::vector<double> outputs = network_outputs(network, std::move(values));
    for (std::size_t r = 0; r < outputs.size(); ++r)
      out[r][i] = is_nan ? std::numeric_limits<float>::quiet_NaN()
                         : static_cast<float>(std::clamp(outputs[r], 0.0, 1.0));
  }
  code::write_width(use, block, out[4]);
  return outside;
}

// Converts a block to metallic by a formula.
struct ConvertBlock {
  const code::Conventions& use;
  const std::array<const float*, 7>& in;
  const std::array<float*, 5>& out;

  std::size_t operator()(const Equation2&) const { return 0; }
  std::size_t operator()(const Projection& projection) const {
    return code::project(use, static_cast<float>(projection.prior), in, out);
  }
  std::size_t operator()(const Equation3& equation) const {
    return code::solve_equation_3(use, equation.mean == MetallicMean::kAlbedo, in, out);
  }
  std::size_t operator()(const KhronosSolver&) const { return code::solve_khronos(use, in, out); }
  std::size_t operator()(const LearnedNetwork& learned) const {
    return interpret(learned.network, use, in, out);
  }
};

void require_direction(const WorkflowConversion& conversion, bool to_metallic) {
  if (conversion.is_to_metallic() == to_metallic) return;
  throw Error(ErrorKind::kUsage, std::string("workflow conversion: ") +
                                     std::string(formula_name(conversion.formula)) + " leads from " +
                                     conversion.source_model() + " to " + conversion.target_model() +
                                     ", not the other way (call the other function)");
}

}  // namespace

workflow_code::WidthParameter width_parameter(RoughnessConvention width) {
  if (width == RoughnessConvention::kAlpha) return code::WidthParameter::kAlpha;
  return width == RoughnessConvention::kGlossiness ? code::WidthParameter::kGlossiness
                                                   : code::WidthParameter::kRoughness;
}

workflow_code::Conventions conventions_of(const WorkflowConversion& conversion) {
  const double f0 = conversion.metallic.dielectric_f0;
  const bool scaled = conversion.metallic.diffuse == DiffuseConvention::kScaled;
  const auto specular = width_parameter(conversion.specular.width),
             metallic = width_parameter(conversion.metallic.width);
  const bool to_metallic = conversion.is_to_metallic();
  return {static_cast<float>(f0), static_cast<float>(scaled ? 1.0 - f0 : 1.0),
          conversion.specular.diffuse == DiffuseConvention::kScaled, to_metallic ? specular : metallic,
          to_metallic ? metallic : specular};
}

std::size_t convert_workflow(const WorkflowConversion& conversion, std::size_t count,
                             std::span<const float* const> in, std::span<float* const> out) {
  require_valid(conversion, "workflow conversion");
  const code::Conventions use = conventions_of(conversion);
  if (!conversion.is_to_metallic()) {
    const auto sources = rows<5>(in, "metallic materials");
    const auto targets = rows<7>(out, "specular materials");
    return code::convert_rows<code::kSpecularBlock>(
        count, sources, targets,
        [&](const auto& from, const auto& to) { return code::metallic_to_specular(use, from, to); });
  }
  const auto sources = rows<7>(in, "specular materials");
  const auto targets = rows<5>(out, "metallic materials");
  return code::convert_rows<code::kMetallicBlock>(
      count, sources, targets, [&](const auto& from, const auto& to) {
        return std::visit(ConvertBlock{use, from, to}, conversion.formula);
      });
}

MetallicMaterial to_metallic(const WorkflowConversion& conversion, const SpecularMaterial& material) {
  require_direction(conversion, true);
  const auto& [diffuse, specular, width] = material;
  MetallicMaterial result;
  const std::array<const float*, 7> in = {&diffuse[0],  &diffuse[1],  &diffuse[2], &specular[0],
                                          &specular[1], &specular[2], &width};
  auto& color = result.base_color;
  const std::array<float*, 5> out = {&color[0], &color[1], &color[2], &result.metallic, &result.width};
  convert_workflow(conversion, 1, in, out);
  return result;
}

SpecularMaterial to_specular(const WorkflowConversion& conversion, const MetallicMaterial& material) {
  require_direction(conversion, false);
  SpecularMaterial result;
  const auto& color = material.base_color;
  const std::array<const float*, 5> in = {&color[0], &color[1], &color[2], &material.metallic,
                                          &material.width};
  auto& [diffuse, specular, width] = result;
  const std::array<float*, 7> out = {&diffuse[0],  &diffuse[1],  &diffuse[2], &specular[0],
                                     &specular[1], &specular[2], &width};
  convert_workflow(conversion, 1, in, out);
  return result;
}

}  // namespace remap
