// This file reads and writes warp fits as JSON. Entries of the table are base64 (RFC 4648), which needs 150
// KB for 128^2 nodes instead of 400 KB for numbers. The bytes of a number have little-endian order. Floats
// are written as their bits.
#include "stages/warp_json.hpp"

#include "converter/converter_data.hpp"
#include "core/base64.hpp"
#include "core/json_field.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr const char* kSeparable = "separable";
constexpr const char* kQuadratic = "quadratic";
constexpr const char* kBlended = "blended";
constexpr const char* kCopied = "copied";

std::vector<std::uint8_t> read_base64(const Field& field) {
  const std::string text = field.text();
  field.require(text.size() % 4 == 0, "base64 in whole groups of four");
  auto bytes = from_base64<std::vector<std::uint8_t>>(text);
  field.require(bytes.has_value(), "base64 (A-Z a-z 0-9 + /)");
  return *std::move(bytes);
}

// Writes the bytes of each number, the lowest byte first.
template <typename Number>
std::vector<std::uint8_t> bytes_of(const std::vector<Number>& numbers) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(numbers.size() * sizeof(Number));
  for (const Number number : numbers)
    for (std::size_t k = 0; k < sizeof(Number); ++k)
      bytes.push_back(static_cast<std::uint8_t>(number >> 8 * k & 255u));
  return bytes;
}

template <typename Number>
std::vector<Number> read_numbers(const Field& field) {
  const std::vector<std::uint8_t> bytes = read_base64(field);
  field.require(bytes.size() % sizeof(Number) == 0,
                "base64 of integers of " + std::to_string(sizeof(Number)) + " bytes");
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < bytes.size(); ++i)
    numbers[i / sizeof(Number)] = static_cast<Number>(
        numbers[i / sizeof(Number)] | static_cast<std::uint32_t>(bytes[i]) << 8 * (i % sizeof(Number)));
  return numbers;
}

std::string palette_text(const std::vector<WarpTexel>& palette) {
  std::vector<std::uint32_t> values;
  values.reserve(palette.size() * kWarpParameters);
  for (const WarpTexel& texel : palette)
    for (const float value : texel) values.push_back(__builtin_bit_cast(std::uint32_t, value));
  return base64(bytes_of(values));
}

std::vector<WarpTexel> read_palette(const Field& field) {
  const auto values = read_numbers<std::uint32_t>(field);
  field.require(values.size() % kWarpParameters == 0, "base64 of seven floats per texel");
  std::vector<WarpTexel> palette(values.size() / kWarpParameters);
  for (std::size_t i = 0; i < values.size(); ++i)
    palette[i / kWarpParameters][i % kWarpParameters] = __builtin_bit_cast(float, values[i]);
  return palette;
}

template <typename Floats>
Json floats_json(const Floats& values) {
  Json list = Json::list();
  for (const float value : values) list.push_back(decimal_value(value));
  return list;
}

std::vector<float> read_floats(const Field& field) {
  return field.list(1, [](const Field& entry) { return static_cast<float>(entry.number()); });
}

std::array<float, kWarpParameters> read_parameters(const Field& field) {
  std::array<float, kWarpParameters> values{};
  for (std::size_t p = 0; p < values.size(); ++p)
    values[p] = static_cast<float>(field.at(p, values.size()).number());
  return values;
}

CompiledWarp read_compiled(const Field& mapping) {
  CompiledWarp warp;
  const Field space = mapping["coordinates"], table = mapping["table"];
  warp.coordinates.dimension = static_cast<std::size_t>(space["dimension"].count());
  warp.coordinates.least_alpha = static_cast<float>(space["alpha"].at(0, 2).number());
  warp.coordinates.largest_alpha = static_cast<float>(space["alpha"].at(1, 2).number());
  const std::string kind = space["kind"].text();
  space["kind"].require(kind == kSeparable || kind == kQuadratic, "separable or quadratic");
  if (kind == kQuadratic)
    warp.coordinates.terms = QuadraticTerms{read_floats(space["weights"])};
  else
    warp.coordinates.terms = SeparableTerms{read_floats(space["diffuse"]), read_floats(space["specular"]),
                                            read_floats(space["offset"])};
  warp.table.nodes = static_cast<std::size_t>(table["nodes"].count());
  warp.table.low = read_floats(table["low"]);
  warp.table.high = read_floats(table["high"]);
  const std::string entries = table["kind"].text();
  table["kind"].require(entries == kBlended || entries == kCopied, "blended or copied");
  if (entries == kCopied)
    warp.table.entries =
        CopiedNodes{read_palette(table["palette"]), read_numbers<std::uint16_t>(table["indices"])};
  else
    warp.table.entries = BlendedNodes{read_parameters(table["least"]), read_parameters(table["largest"]),
                                      read_base64(table["codes"])};
  return warp;
}

void add_terms(Json& json, const SeparableTerms& terms) {
  json["kind"] = kSeparable;
  json["diffuse"] = floats_json(terms.diffuse);
  json["specular"] = floats_json(terms.specular);
  json["offset"] = floats_json(terms.offset);
}
void add_terms(Json& json, const QuadraticTerms& terms) {
  json["kind"] = kQuadratic;
  json["weights"] = floats_json(terms.weights);
}

Json coordinates_json(const AppearanceCoordinates& space) {
  Json json = {{"dimension", space.dimension},
               {"alpha", floats_json(std::array{space.least_alpha, space.largest_alpha})}};
  std::visit([&](const auto& terms) { add_terms(json, terms); }, space.terms);
  return json;
}

void add_entries(Json& json, const BlendedNodes& entries) {
  json["kind"] = kBlended;
  json["least"] = floats_json(entries.least);
  json["largest"] = floats_json(entries.largest);
  json["codes"] = base64(entries.codes);
}
void add_entries(Json& json, const CopiedNodes& entries) {
  json["kind"] = kCopied;
  json["palette"] = palette_text(entries.palette);
  json["indices"] = base64(bytes_of(entries.indices));
}

Json table_json(const ParameterTable& table) {
  Json json = {{"nodes", table.nodes}, {"low", floats_json(table.low)}, {"high", floats_json(table.high)}};
  std::visit([&](const auto& entries) { add_entries(json, entries); }, table.entries);
  return json;
}

}  // namespace

std::string fit_to_json(const WarpMapFit& fit) {
  require_valid(fit.warp, fit.id);
  const auto side = [](const std::string& model) {
    return Json{{"model", model}, {"workflow", "specular"}, {"diffuse", "plain"}, {"roughness", "alpha"}};
  };
  const Json json = {{"format", "remap-fit"},
                     {"version", kFitFormatVersion},
                     {"id", fit.id},
                     {"source", side(fit.source_model)},
                     {"target", side(fit.template_model)},
                     {"mapping",
                      {{"kind", kWarpKind},
                       {"coordinates", coordinates_json(fit.warp.coordinates)},
                       {"table", table_json(fit.warp.table)}}},
                     {"copy_rms_error", fit.copy_rms_error},
                     {"method", fit.method},
                     {"remarks", fit.remarks},
                     {"tool", "remapc " + fit.tool_version}};
  return json.dump(1) + "\n";
}

WarpMapFit read_warp_fit(const Field& root) {
  WarpMapFit fit;
  fit.id = read_id(root["id"]);
  fit.source_model = read_model(root["source"]["model"]);
  fit.template_model = read_model(root["target"]["model"]);
  fit.warp = read_compiled(root["mapping"]);
  require_valid(fit.warp, root.context());
  fit.copy_rms_error = root["copy_rms_error"].number();
  root["copy_rms_error"].require(fit.copy_rms_error >= 0.0 || fit.copy_rms_error == -1.0,
                                 "a fraction from 0, or -1 if it is unknown");
  fit.method = root["method"].text_dictionary();
  fit.remarks = root["remarks"].texts();
  fit.tool_version = read_tool_version(root["tool"]);
  return fit;
}

}  // namespace remap
