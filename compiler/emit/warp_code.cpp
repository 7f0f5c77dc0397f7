// This file writes appearance warps as C++: the code of runtime/stages/code with the numbers of the warp.
#include <array>
#include <span>
#include <type_traits>

#include "core/number_text.hpp"
#include "emit/header_data.hpp"
#include "formula/text_template.hpp"

namespace remap {
namespace {

// Returns numbers as `a,b,c`, with `a_line` numbers on each line. It has no spaces, because tables are large.
template <typename Numbers>
std::string list_text(const Numbers& numbers, std::size_t a_line) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) text += i % a_line == 0 ? ",\n" : ",";
    if constexpr (std::is_same_v<typename Numbers::value_type, float>)
      text += float_literal(numbers[i]);
    else
      text += std::to_string(numbers[i]);
  }
  return text;
}

template <typename Number>
std::string array_text(const std::string& type, const std::string& name, const std::vector<Number>& numbers,
                       std::size_t a_line) {
  return "inline constexpr " + type + " " + name + "[] = {\n" + list_text(numbers, a_line) + "};\n";
}

std::string width_text(const PackedWarp& warp) {
  const std::array numbers = {warp.least_alpha, warp.largest_alpha, warp.width_start, warp.width_scale};
  return "{" + list_text(numbers, 4) + "}";
}

std::string coordinates_of(const PackedWarp& warp) {
  if (!warp.is_separable())
    return array_text("float", "kWeights", warp.weights, 8) +
           "inline constexpr QuadraticView<kDimension> kCoordinates{kWeights, " + width_text(warp) + "};\n";
  return array_text("float", "kDiffuse", warp.diffuse, 4) +
         array_text("float", "kWidthNodes", warp.width_nodes, 16) +
         "inline constexpr SeparableView<kDimension> kCoordinates{kDiffuse, kWidthNodes, " +
         std::to_string(warp.last_width) + ", " + width_text(warp) + "};\n";
}

std::string grid_text(const PackedWarp& warp) {
  const auto used = [&](const auto& numbers) {
    return list_text(std::span(numbers).first(warp.dimension), 3);
  };
  return "{" + std::to_string(warp.nodes) + ", {" + used(warp.low) + "}, {" + used(warp.scale) + "}}";
}

constexpr std::string_view kBlendedTable = R"(inline constexpr std::size_t kNodes = @count@;
inline constexpr float kLeast[] = {@least@};
inline constexpr float kLargest[] = {@largest@};
@codes@

// The codes as the pass reads them, decoded when they are first asked for.
struct DecodedTable {
  DecodedTable() noexcept { decode_entries(kCodes, kNodes, kLeast, kLargest, entries); }
  float entries[kNodes * kEntryLanes];
};
inline BlendedView<kDimension> table() noexcept {
  static const DecodedTable decoded;
  return {@grid@, decoded.entries};
}
)";

std::string table_of(const PackedWarp& warp, const BlendedNodes& entries) {
  const std::size_t count = entries.codes.size() / kWarpParameters;
  return fill_template(kBlendedTable, {{"count", std::to_string(count)},
                                       {"least", list_text(entries.least, 7)},
                                       {"largest", list_text(entries.largest, 7)},
                                       {"codes", array_text("std::uint8_t", "kCodes", entries.codes, 32)},
                                       {"grid", grid_text(warp)}});
}

constexpr std::string_view kCopiedTable = R"(@palette@
@indices@

inline CopiedView<kDimension> table() noexcept {
  return {@grid@, kIndices, kPalette};
}
)";

std::string table_of(const PackedWarp& warp, const CopiedNodes& entries) {
  return fill_template(kCopiedTable,
                       {{"palette", array_text("float", "kPalette", warp.palette, 7)},
                        {"indices", array_text("std::uint16_t", "kIndices", entries.indices, 20)},
                        {"grid", grid_text(warp)}});
}

}  // namespace

MaterialCode material_code(const WarpHeader& header) {
  const PackedWarp& warp = header.warp;
  const auto table = [&](const auto& entries) { return table_of(warp, entries); };
  const std::string dimension = std::to_string(warp.dimension);
  MaterialCode code;
  code.formula = kWarpKind;
  code.constants =
      "static constexpr const char* kTemplateModel = kTargetModel;\n"
      "// RMS distance in appearance from the exact copy of template texels; shares of the template's "
      "spread, "
      "-1 where unknown.\n"
      "static constexpr double kCopyRmsError = " +
      double_literal(header.copy_rms_error) + ";\n";
  code.functions =
      code_files({"bits", "floats", "rows", "appearance", warp.is_separable() ? "separable" : "quadratic",
                  warp.is_blended() ? "blended" : "copied", "warp_block"}) +
      "\ninline constexpr std::size_t kDimension = " + dimension + ";\n" + coordinates_of(warp) +
      std::visit(table, header.entries);
  code.block = "kWarpBlock";
  code.call = "warp_block<" + dimension + ">(detail::kCoordinates, detail::table(), from, to)";
  code.within = "1e-4f";
  return code;
}

}  // namespace remap
