// Sums of Gaussians as fitted: loops over the vectors, in double precision, since large weights cancel.
#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remapc {
namespace {

using remap::KernelExpansion;

std::string normalized_text(const remap::Scaling& scaling, const std::string& value) {
  const std::string t =
      scaling.pole == 0.0 ? value : value + " / (" + value + " + " + double_literal(scaling.pole) + ")";
  return "(" + t + " - " + double_literal(scaling.offset) + ") * " + double_literal(scaling.scale);
}

std::string rows_function(const std::string& name, const std::string& table, const KernelExpansion& expansion,
                          int squarings) {
  const std::size_t width = expansion.inputs.size();
  std::vector<std::string> vectors;
  for (std::size_t v = 0; v < expansion.count(); ++v) {
    vectors.push_back(double_literal(expansion.weights[v]));
    for (std::size_t k = 0; k < width; ++k)
      vectors.push_back(double_literal(expansion.vectors[v * width + k]));
  }
  if (expansion.count() == 0) vectors.assign(width + 1, "0.0");
  double gamma = expansion.gamma;
  std::string squaring_text;
  for (int i = 0; i < squarings; ++i) {
    gamma *= 0.5;
    squaring_text += "value = value * value;\n";
  }
  const bool two = width == 2;
  return "\n" + fill_template(code_file("gaussians"),
                              {{"vectors", table_code("double", table, width + 1, vectors)},
                               {"table", table},
                               {"name", name},
                               {"x", normalized_text(expansion.inputs[0], "a")},
                               {"y", two ? normalized_text(expansion.inputs[1], "s") : "s * 0.0"},
                               {"vector_y", two ? "gaussian[2]" : "0.0"},
                               {"bias", double_literal(expansion.bias)},
                               {"gamma", double_literal(gamma)},
                               {"squarings", squaring_text},
                               {"range", double_literal(1.0 / expansion.output.scale)},
                               {"offset", double_literal(expansion.output.offset)}});
}

}  // namespace

MappingCode mapping_code(const FittedGaussians& gaussians) {
  const remap::Svr& svr = gaussians.svr;
  MappingCode code;
  code.form = CodeForm::kRows;
  code.functions =
      code_files({"exp_of_doubles"}) +
      rows_function("target_alpha_rows", "kAlphaGaussians", svr.alpha, gaussians.alpha_squarings) +
      rows_function("target_specular_rows", "kSpecularGaussians", svr.specular, gaussians.specular_squarings);
  return code;
}

}  // namespace remapc
