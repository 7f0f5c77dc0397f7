// The header of an appearance warp: the pass of the compiled warp, and its numbers.
#include <algorithm>
#include <cmath>
#include <limits>

#include "emit/code_text.hpp"
#include "emit/emit.hpp"
#include "emit/mapping_code.hpp"
#include "emit/material_header.hpp"
#include "text/number_text.hpp"
#include "text/report_text.hpp"
#include "warp/packed_warp.hpp"

namespace remapc {
namespace {

using remap::float_literal;
using remap::PackedWarp;
using remap::WarpTexel;

std::string text_of(float value) { return float_literal(value); }
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
  std::string_view code;
  std::string numbers;
};

std::string width_text(const PackedWarp& warp) {
  return "{" +
         list_text(std::array{warp.least_alpha, warp.largest_alpha, warp.width_start, warp.width_scale}, 4,
                   4) +
         "}";
}

Part part_of(const PackedWarp& warp, const remap::PackedSeparable& terms) {
  return {kSeparableText,
          array_text("float", "kDiffuse", terms.diffuse, 4) +
              array_text("float", "kWidthNodes", terms.width_nodes, 16) +
              "inline constexpr SeparableView<kDimension> kCoordinates{kDiffuse, kWidthNodes, " +
              std::to_string(terms.last_width) + ", " + width_text(warp) + "};\n"};
}

Part part_of(const PackedWarp& warp, const remap::PackedQuadratic& terms) {
  return {kQuadraticText, array_text("float", "kWeights", terms.weights, 8) +
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
  return {kBlendedText, "inline constexpr std::size_t kNodes = " +
                            std::to_string(entries.codes.size() / remap::kWarpParameters) + ";\n" +
                            small_array_text("kLeast", entries.least) +
                            small_array_text("kLargest", entries.largest) +
                            array_text("std::uint8_t", "kCodes", entries.codes, 32) +
                            std::string(kDecodedTable) + grid_text(warp) + ", decoded.entries};\n}\n"};
}

Part part_of(const PackedWarp& warp, const remap::CopiedNodes& entries) {
  return {kCopiedText, array_text("float", "kPalette", std::get<remap::PackedCopied>(warp.table).palette, 7) +
                           array_text("std::uint16_t", "kIndices", entries.indices, 20) +
                           "\ninline CopiedView<kDimension> table() noexcept {\n  return {" +
                           grid_text(warp) + ", kIndices, kPalette};\n}\n"};
}

// Texels of all kinds, the same on every machine: fractions of multiples of irrational numbers.
WarpTexel candidate(std::size_t number) {
  constexpr std::array<double, remap::kWarpParameters> kSteps = {0.7548777, 0.5698403, 0.4301597, 0.8191725,
                                                                 0.6710436, 0.5497005, 0.4503046};
  WarpTexel texel;
  for (std::size_t p = 0; p < texel.size(); ++p) {
    const double place = static_cast<double>(number + 1) * kSteps[p];
    texel[p] = static_cast<float>(std::floor((place - std::floor(place)) * 1024.0) / 1024.0);
  }
  return texel;
}

// How far a texel is from where the nearest node changes, in nodes; what blends has no such places.
double distance_to_tie(const remap::CompiledWarp& warp, const WarpTexel& texel) {
  double distance = 1.0;
  if (!std::holds_alternative<remap::CopiedNodes>(warp.table.entries)) return distance;
  const auto position = node_position_of(warp, texel);
  for (std::size_t k = 0; k < warp.coordinates.dimension; ++k)
    distance = std::min(distance, std::fabs(position[k] - std::floor(position[k]) - 0.5));
  return distance;
}

GoldenRows golden_rows(const remap::CompiledWarp& warp) {
  constexpr std::size_t kTexels = 8, kCandidates = 512;
  GoldenRows golden;
  golden.in.resize(remap::kWarpParameters);
  golden.out.resize(remap::kWarpParameters);
  for (std::size_t i = 0; i < kCandidates && golden.in[0].size() < kTexels; ++i) {
    const WarpTexel texel = candidate(i);
    if (distance_to_tie(warp, texel) < 0.01) continue;
    const WarpTexel result = evaluate_warp(warp, texel);
    for (std::size_t p = 0; p < texel.size(); ++p) {
      golden.in[p].push_back(texel[p]);
      golden.out[p].push_back(result[p]);
    }
  }
  return golden;
}

// Text of a file in a comment: what could end the line becomes a space.
std::string comment_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == '\\') c = ' ';
  return "// " + text + "\n";
}

std::string provenance(const remap::WarpMapFit& fit) {
  const bool copied = std::holds_alternative<remap::CopiedNodes>(fit.warp.table.entries);
  std::string text = std::string("// By an appearance warp (An et al. 2011): reflectances of a template, ") +
                     (copied ? "copied" : "blended between\n// nodes of a table") + ".\n";
  for (const auto& [key, value] : fit.method) text += comment_line(key + ": " + value);
  if (fit.copy_rms_error >= 0.0)
    text += "// From an exact copy of template texels: " + percent(fit.copy_rms_error) +
            " of the template's spread (RMS).\n";
  for (const std::string& remark : fit.remarks) text += comment_line(remark);
  text.pop_back();
  return text;
}

MaterialEnd end_of(const std::string& model) {
  return {model,
          "specular",
          "plain",
          {{"diffuse", 3, "diffuse reflectance"},
           {"specular", 3, "specular reflectance at normal incidence, or scale"},
           {"alpha", 1, "microfacet width"}}};
}

}  // namespace

std::string emit_header(const remap::WarpMapFit& fit) {
  require_valid(fit.warp, fit.id);
  const PackedWarp warp = packed(fit.warp);
  const Part coordinates =
      std::visit([&](const auto& terms) { return part_of(warp, terms); }, warp.coordinates);
  const Part table =
      std::visit([&](const auto& entries) { return part_of(warp, entries); }, fit.warp.table.entries);
  const std::string dimension = std::to_string(warp.dimension);
  MaterialHeader header;
  header.id = fit.id;
  header.formula = remap::kWarpKind;
  header.provenance = provenance(fit);
  header.source = end_of(fit.source_model);
  header.target = end_of(fit.template_model);
  header.constants =
      "inline constexpr const char* kTemplateModel = kTargetModel;\n"
      "// RMS distance in appearance from the exact copy of template texels; shares of the template's "
      "spread, "
      "-1 where unknown.\n"
      "inline constexpr double kCopyRmsError = " +
      double_literal(fit.copy_rms_error) + ";\n";
  header.code =
      code_text({kFloatsText, kRowsText, kAppearanceText, coordinates.code, table.code, kWarpBlockText}) +
      "\ninline constexpr std::size_t kDimension = " + dimension + ";\n" + coordinates.numbers +
      table.numbers;
  header.block = "kWarpBlock";
  header.call = "warp_block<" + dimension + ">(detail::kCoordinates, detail::table(), from, to)";
  header.within = "1e-4f";
  header.golden = golden_rows(fit.warp);
  return material_header(header);
}

}  // namespace remapc
