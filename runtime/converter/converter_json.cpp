// The file of converters: one number has one text, and what a review compares stands on a line of its own.
#include <algorithm>
#include <cmath>

#include "converter/converter_data.hpp"
#include "converter/converter_fields.hpp"
#include "core/json_field.hpp"
#include "core/number_text.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

constexpr std::int64_t kFormatVersion = 1;
constexpr std::int64_t kMostCells = 4096;

// The shortest decimal that reads back as this float.
double decimal(float value) { return decimal_value(value); }

// The coefficients of a cell and a power a line.
std::string function_text(const LoweredFunction& function) {
  const PiecewisePolynomial& polynomial = function.polynomial;
  Json head = {{"pole", decimal(polynomial.pole)},
               {"scale", decimal(polynomial.scale)},
               {"start", decimal(polynomial.start)},
               {"middle", decimal(polynomial.middle)},
               {"cell_count", polynomial.cell_count},
               {"degrees", polynomial.degrees},
               {"bound", finite(function.bound)},
               {"sampled", finite(function.sampled)},
               {"rises_with_alpha", function.rises_with_alpha},
               {"rises_with_specular", function.rises_with_specular}};
  std::string text = head.dump();
  text.back() = ',';
  text += "\n        \"coefficients\": [";
  const char* separator = "\n";
  const float* next = polynomial.coefficients.data();
  for (int cell = 0; cell < polynomial.cell_count; ++cell)
    for (const int degree : polynomial.degrees) {
      Json line = Json::list();
      for (int k = 0; k <= degree; ++k) line.push_back(decimal(*next++));
      text += separator + std::string(10, ' ') + line.dump();
      separator = ",\n";
    }
  return text + "]}";
}

std::string golden_text(const std::vector<GoldenTexel>& golden) {
  std::string text = "[";
  const char* separator = "\n";
  for (const GoldenTexel& g : golden) {
    const Json line = {decimal(g.width),        decimal(g.specular),     decimal(g.width_out),
                       decimal(g.specular_out), decimal(g.width_within), decimal(g.specular_within)};
    text += separator + std::string(8, ' ') + line.dump();
    separator = ",\n";
  }
  return text + "]";
}

}  // namespace

std::string converter_to_json(const ConverterData& data) {
  const Lowered& lowered = data.lowered;
  std::string text = "{\"id\": " + Json(data.info.id).dump();
  const auto add = [&text](const char* name, const std::string& value) {
    text += ",\n      \"" + std::string(name) + "\": " + value;
  };
  add("source", side_json(data.info.source).dump());
  add("target", side_json(data.info.target).dump());
  add("domain", domain_json(data.info).dump());
  add("rms_error", errors_json(data.info).dump());
  add("ssim", ssim_json(data.info).dump());
  add("alpha", function_text(lowered.alpha));
  add("specular", function_text(lowered.specular));
  const auto limit = [](const std::optional<float>& value) { return value ? Json(decimal(*value)) : Json(); };
  const Json limits = {{"alpha", limit(lowered.alpha_limit)}, {"specular", limit(lowered.specular_limit)}};
  add("limits", limits.dump());
  const Json seams = {{"alpha", finite(lowered.alpha_seam)}, {"specular", finite(lowered.specular_seam)}};
  add("seams", seams.dump());
  const auto add_series = [&](const char* name, Json ends, const LoweredSeries& series) {
    ends["alpha_from"] = decimal(series.alpha_from);
    ends["specular_from"] = decimal(series.specular_from);
    std::string head = ends.dump();
    head.back() = ',';
    add(name, head + " \"polynomial\": " + function_text(series.function) + "}");
  };
  if (lowered.wide)
    add_series("wide", {{"mapping_to", decimal(lowered.wide->mapping_to)}}, lowered.wide->specular);
  if (lowered.bright) add_series("bright", Json::object(), *lowered.bright);
  add("golden", golden_text(data.golden));
  return text + "}";
}

namespace {

float read_float(const Field& field) {
  const float value = static_cast<float>(field.number());
  field.require(std::isfinite(value), "a number that a float can hold");
  return value;
}

int read_whole(const Field& field, std::int64_t least, std::int64_t most) {
  const std::optional<std::int64_t> whole = field.json().whole();
  field.require(whole && *whole >= least && *whole <= most,
                "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(*whole);
}

LoweredFunction read_function(const Field& field) {
  LoweredFunction function;
  PiecewisePolynomial& polynomial = function.polynomial;
  polynomial.pole = read_float(field["pole"]);
  polynomial.scale = read_float(field["scale"]);
  polynomial.start = read_float(field["start"]);
  polynomial.middle = read_float(field["middle"]);
  polynomial.cell_count = read_whole(field["cell_count"], 1, kMostCells);
  field["scale"].require(polynomial.cell_count > 1 || polynomial.scale == 1.0f, "1 for one cell");
  const Field degrees = field["degrees"];
  polynomial.degrees =
      degrees.list(1, [](const Field& entry) { return read_whole(entry, -1, kHighestDegree); });
  degrees.require(polynomial.degrees.size() <= kMostPowers && polynomial.degrees.back() >= 0,
                  "up to " + std::to_string(kMostPowers) + " degrees, the last of them from 0");
  const std::size_t powers = polynomial.degrees.size();
  const Field lines = field["coefficients"];
  const std::size_t line_count = powers * static_cast<std::size_t>(polynomial.cell_count);
  for (std::size_t line = 0; line < line_count; ++line) {
    const auto count = static_cast<std::size_t>(polynomial.degrees[line % powers] + 1);
    const Field numbers = lines.at(line, line_count);
    for (std::size_t k = 0; k < count; ++k)
      polynomial.coefficients.push_back(read_float(numbers.at(k, count)));
  }
  function.bound = field["bound"].number();
  function.sampled = field["sampled"].number();
  function.rises_with_alpha = field.flag("rises_with_alpha");
  function.rises_with_specular = field.flag("rises_with_specular");
  return function;
}

std::optional<double> read_optional(const Field& field) {
  return field.is_null() ? std::nullopt : std::optional<double>(field.number());
}

LoweredSeries read_series(const Field& field) {
  return {read_float(field["alpha_from"]), read_float(field["specular_from"]),
          read_function(field["polynomial"])};
}

std::optional<float> read_limit(const Field& field) {
  if (field.is_null()) return std::nullopt;
  field.require(read_float(field) > 0.0f, "a number above 0");
  return read_float(field);
}

GoldenTexel read_golden(const Field& field) {
  const auto number = [&](std::size_t index) { return read_float(field.at(index, 6)); };
  return {number(0), number(1), number(2), number(3), number(4), number(5)};
}

Lowered read_lowered(const Field& field) {
  Lowered lowered;
  lowered.alpha = read_function(field["alpha"]);
  lowered.specular = read_function(field["specular"]);
  lowered.alpha_limit = read_limit(field["limits"]["alpha"]);
  lowered.specular_limit = read_limit(field["limits"]["specular"]);
  lowered.alpha_seam = field["seams"]["alpha"].number();
  lowered.specular_seam = field["seams"]["specular"].number();
  if (field.contains("wide"))
    lowered.wide = {read_float(field["wide"]["mapping_to"]), read_series(field["wide"])};
  if (field.contains("bright")) lowered.bright = read_series(field["bright"]);
  field.require(!lowered.wide || lowered.alpha_limit, "a limit of alpha beside the wide regime");
  field.require(!lowered.bright || lowered.specular_limit, "a limit of specular beside the bright regime");
  return lowered;
}

}  // namespace

ConverterData read_converter(const Field& field) {
  ConverterData data;
  data.info.id = read_id(field["id"]);
  data.info.source = read_side(field["source"]);
  data.info.target = read_side(field["target"]);
  data.info.roughness = read_range(field["domain"]["roughness"]);
  data.info.specular = read_range(field["domain"]["specular"]);
  field["domain"].require(data.info.roughness.min >= 0.0 && data.info.specular.min >= 0.0,
                          "ranges from 0 or more");
  data.info.roughness_rms_error = read_optional(field["rms_error"]["roughness"]);
  data.info.specular_rms_error = read_optional(field["rms_error"]["specular"]);
  data.info.image_rms_error = read_optional(field["rms_error"]["image"]);
  data.info.ssim = read_optional(field["ssim"]);
  data.lowered = read_lowered(field);
  data.golden = field["golden"].list(1, read_golden);
  return data;
}

std::optional<ConverterData> read_fitted_converter(const Field& root) {
  if (!root.contains("converter"))
    root.fail(std::string("holds no converter: an older remapc wrote it (") + kMakeAgain + ")");
  const Field section = root["converter"];
  return section.is_null() ? std::nullopt : std::optional(read_converter(section));
}

std::string converters_to_json(const std::vector<ConverterData>& converters) {
  std::string text =
      "{\n  \"format\": \"remap-converters\",\n  \"version\": " + std::to_string(kFormatVersion) +
      ",\n  \"converters\": [";
  const char* separator = "\n";
  for (const ConverterData& data : converters) {
    text += separator + std::string(4, ' ') + converter_to_json(data);
    separator = ",\n";
  }
  return text + "\n  ]\n}\n";
}

std::vector<ConverterData> converters_from_json(std::string_view text, const std::string& place) {
  const Json json = parse_json(text, place);
  const Field root(json, place);
  root["format"].require(root["format"].text() == "remap-converters", "remap-converters");
  root["version"].require(root["version"].count() == kFormatVersion, std::to_string(kFormatVersion));
  return root["converters"].list(0, read_converter);
}

}  // namespace remap
