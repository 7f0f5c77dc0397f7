// Appearance warps as C++: the pass of runtime/warp/code with the numbers of the warp.
#include <array>

#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::PackedWarp;

std::string text_of(float value) { return remap::float_literal(value); }
template <typename Whole>
std::string text_of(Whole value) {
  return std::to_string(value);
}

// `a,b,c`, as many a line as given; without spaces, since tables have a quarter of a million numbers.
template <typename Numbers>
std::string list_text(const Numbers& numbers, std::size_t count, std::size_t a_line) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += i % a_line == 0 ? ",\n" : ",";
    text += text_of(numbers[i]);
  }
  return text;
}

template <typename Number>
std::string array_text(const std::string& type, const std::string& name, const std::vector<Number>& numbers,
                       std::size_t a_line) {
  return "inline constexpr " + type + " " + name + "[] = {\n" + list_text(numbers, numbers.size(), a_line) +
         "};\n";
}

template <typename Numbers>
std::string small_array_text(const std::string& name, const Numbers& numbers) {
  return "inline constexpr float " + name + "[] = {" + list_text(numbers, numbers.size(), numbers.size()) +
         "};\n";
}

// What one kind of coordinates or of table adds to the header.
struct Part {
  std::string_view file;
  std::string numbers;
};

std::string width_text(const PackedWarp& warp) {
  const std::array numbers = {warp.least_alpha, warp.largest_alpha, warp.width_start, warp.width_scale};
  return "{" + list_text(numbers, 4, 4) + "}";
}

Part part_of(const PackedWarp& warp, const remap::PackedSeparable& terms) {
  return {"separable", array_text("float", "kDiffuse", terms.diffuse, 4) +
                           array_text("float", "kWidthNodes", terms.width_nodes, 16) +
                           "inline constexpr SeparableView<kDimension> kCoordinates{kDiffuse, kWidthNodes, " +
                           std::to_string(terms.last_width) + ", " + width_text(warp) + "};\n"};
}

Part part_of(const PackedWarp& warp, const remap::PackedQuadratic& terms) {
  return {"quadratic", array_text("float", "kWeights", terms.weights, 8) +
                           "inline constexpr QuadraticView<kDimension> kCoordinates{kWeights, " +
                           width_text(warp) + "};\n"};
}

std::string grid_text(const PackedWarp& warp) {
  return "{" + std::to_string(warp.nodes) + ", {" + list_text(warp.low, warp.dimension, 3) + "}, {" +
         list_text(warp.scale, warp.dimension, 3) + "}}";
}

constexpr std::string_view kDecodedTable = R"(
// The codes as the pass reads them, decoded when they are first asked for.
struct DecodedTable {
  DecodedTable() noexcept { decode_entries(kCodes, kNodes, kLeast, kLargest, entries); }
  float entries[kNodes * kEntryLanes];
};
inline BlendedView<kDimension> table() noexcept {
  static const DecodedTable decoded;
  return {)";

Part part_of(const PackedWarp& warp, const remap::BlendedNodes& entries) {
  return {"blended", "inline constexpr std::size_t kNodes = " +
                         std::to_string(entries.codes.size() / remap::kWarpParameters) + ";\n" +
                         small_array_text("kLeast", entries.least) +
                         small_array_text("kLargest", entries.largest) +
                         array_text("std::uint8_t", "kCodes", entries.codes, 32) +
                         std::string(kDecodedTable) + grid_text(warp) + ", decoded.entries};\n}\n"};
}

Part part_of(const PackedWarp& warp, const remap::CopiedNodes& entries) {
  return {"copied", array_text("float", "kPalette", std::get<remap::PackedCopied>(warp.table).palette, 7) +
                        array_text("std::uint16_t", "kIndices", entries.indices, 20) +
                        "\ninline CopiedView<kDimension> table() noexcept {\n  return {" + grid_text(warp) +
                        ", kIndices, kPalette};\n}\n"};
}

}  // namespace

MaterialCode material_code(const WarpHeader& header) {
  const PackedWarp& warp = header.warp;
  const auto part = [&](const auto& kind) { return part_of(warp, kind); };
  const Part coordinates = std::visit(part, warp.coordinates), table = std::visit(part, header.entries);
  const std::string dimension = std::to_string(warp.dimension);
  MaterialCode code;
  code.formula = remap::kWarpKind;
  code.constants =
      "inline constexpr const char* kTemplateModel = kTargetModel;\n"
      "// RMS distance in appearance from the exact copy of template texels; shares of the template's "
      "spread, "
      "-1 where unknown.\n"
      "inline constexpr double kCopyRmsError = " +
      double_literal(header.copy_rms_error) + ";\n";
  code.functions = code_files({"floats", "rows", "appearance", coordinates.file, table.file, "warp_block"}) +
                   "\ninline constexpr std::size_t kDimension = " + dimension + ";\n" + coordinates.numbers +
                   table.numbers;
  code.block = "kWarpBlock";
  code.call = "warp_block<" + dimension + ">(detail::kCoordinates, detail::table(), from, to)";
  code.within = "1e-4f";
  return code;
}

}  // namespace remapc
