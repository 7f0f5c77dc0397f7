// This file writes conversions between workflows as C++. It takes the code of runtime/stages/code and adds
// the conventions of both ends.
#include "core/number_text.hpp"
#include "emit/mapping_code.hpp"
#include "formula/text_template.hpp"
#include "reference/workflow_conversion.hpp"

namespace remap {
namespace {

// A CodeOf returns the code for a formula.
struct CodeOf {
  MaterialCode operator()(const Equation2&) const {
    // Compilers may fuse products, so results may differ slightly. Conversions to the metallic workflow
    // differ more.
    return code(code_files({"metallic_to_specular"}), "kSpecularBlock", "metallic_to_specular", "", "4e-6f");
  }
  MaterialCode operator()(const Projection& projection) const {
    return to_metallic("projection", "project", literal(projection.prior) + ", ");
  }
  MaterialCode operator()(const Equation3& equation) const {
    const bool by_albedo = equation.mean == MetallicMean::kAlbedo;
    return to_metallic("equation_3", "solve_equation_3", by_albedo ? "true, " : "false, ");
  }
  MaterialCode operator()(const KhronosSolver&) const { return to_metallic("khronos", "solve_khronos", ""); }
  MaterialCode operator()(const LearnedNetwork& learned) const {
    const Network& network = learned.network;
    return code("\ninline constexpr std::size_t kBlock = " + std::to_string(network_block(network)) + ";\n" +
                    network_helpers(network.activation) + network_function("material_network", network) +
                    code_files({"learned"}),
                "kBlock", "by_network", "");
  }

 private:
  static MaterialCode code(const std::string& functions, const std::string& block,
                           const std::string& function, const std::string& argument,
                           const std::string& within = "1e-4f") {
    MaterialCode code;
    code.functions = code_files({"bits", "floats", "conventions", "rows", "width"}) + functions;
    code.block = block;
    code.call = function + "(detail::kConventions, " + argument + "from, to)";
    code.within = within;
    return code;
  }
  static MaterialCode to_metallic(std::string_view file, const std::string& function,
                                  const std::string& argument) {
    return code(code_files({"specular_texels", file}), "kMetallicBlock", function, argument);
  }
};

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
  MaterialCode code = std::visit(CodeOf{}, conversion.formula);
  code.formula = formula_name(conversion.formula);
  code.constants = "static constexpr float kDielectricF0 = " + float_literal(use.dielectric_f0) +
                   ";  // of the metallic workflow";
  code.functions += "\ninline constexpr Conventions kConventions{" + float_literal(use.dielectric_f0) + ", " +
                    float_literal(use.diffuse_of_albedo) + ", " + (use.diffuse_is_scaled ? "true" : "false") +
                    ", " + enumerator(use.width_in) + ", " + enumerator(use.width_out) + "};\n";
  return code;
}

}  // namespace remap
