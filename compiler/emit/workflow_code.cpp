// This file writes conversions between workflows as C++. It takes the code of runtime/stages/code and adds
// the conventions of both ends.
#include "core/number_text.hpp"
#include "emit/header_data.hpp"
#include "formula/text_template.hpp"
#include "reference/workflow_conversion.hpp"

namespace remap {
namespace {

MaterialCode code_with(const std::string& functions, const std::string& block, const std::string& function,
                       const std::string& argument, const std::string& within = "1e-4f") {
  MaterialCode code;
  code.functions = code_files({"bits", "floats", "conventions", "rows", "width"}) + functions;
  code.block = block;
  code.call = function + "(detail::kConventions, " + argument + "from, to)";
  code.within = within;
  return code;
}

MaterialCode metallic_code(std::string_view file, const std::string& function, const std::string& argument) {
  return code_with(code_files({"specular_texels", file}), "kMetallicBlock", function, argument);
}

MaterialCode formula_code(ClosedFormula formula) {
  switch (formula) {
    case ClosedFormula::kEquation2:
      // Compilers may fuse products, so results may differ slightly. The difference is larger for conversions
      // to the metallic workflow.
      return code_with(code_files({"metallic_to_specular"}), "kSpecularBlock", "metallic_to_specular", "",
                       "4e-6f");
    case ClosedFormula::kEquation3:
      return metallic_code("equation_3", "solve_equation_3", "false, ");
    case ClosedFormula::kEquation3ByAlbedo:
      return metallic_code("equation_3", "solve_equation_3", "true, ");
    case ClosedFormula::kKhronos:
      break;
  }
  return metallic_code("khronos", "solve_khronos", "");
}
MaterialCode formula_code(const Projection& projection) {
  return metallic_code("projection", "project", literal(projection.prior) + ", ");
}
MaterialCode formula_code(const Network& network) {
  return code_with("\ninline constexpr std::size_t kBlock = " + std::to_string(network_block(network)) +
                       ";\n" + network_helpers(network.activation) +
                       network_function("material_network", network) + code_files({"learned"}),
                   "kBlock", "by_network", "");
}

std::string enumerator(remap::workflow_code::WidthParameter width) {
  switch (width) {
    case remap::workflow_code::WidthParameter::kAlpha:
      return "WidthParameter::kAlpha";
    case remap::workflow_code::WidthParameter::kGlossiness:
      return "WidthParameter::kGlossiness";
    case remap::workflow_code::WidthParameter::kRoughness:
      break;
  }
  return "WidthParameter::kRoughness";
}

}  // namespace

MaterialCode material_code(const WorkflowConversion& conversion) {
  const remap::workflow_code::Conventions use = conventions_of(conversion);
  MaterialCode code =
      std::visit([](const auto& formula) { return formula_code(formula); }, conversion.formula);
  code.formula = formula_name(conversion.formula);
  code.constants = "static constexpr float kDielectricF0 = " + float_literal(use.dielectric_f0) +
                   ";  // of the metallic workflow";
  code.functions += "\ninline constexpr Conventions kConventions{" + float_literal(use.dielectric_f0) + ", " +
                    float_literal(use.diffuse_of_albedo) + ", " + (use.diffuse_is_scaled ? "true" : "false") +
                    ", " + enumerator(use.width_in) + ", " + enumerator(use.width_out) + "};\n";
  return code;
}

}  // namespace remap
