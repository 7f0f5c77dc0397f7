// A number is always written with the same text, and each field of converters.json has its own line, so that
// a review shows only real changes.
#include "converter/converter_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {

void require_fit_file(const Field& root) {
  if (root["format"].text() != "remap-fit") root.fail("not a fit file (\"format\" must be \"remap-fit\")");
  const std::int64_t version = root["version"].count();
  if (version != kFitFormatVersion)
    root.fail("has format version " + std::to_string(version) + ", but this program reads version " +
              std::to_string(kFitFormatVersion) +
              (version < kFitFormatVersion ? " (make it again by remapc fit or remapc warp)"
                                           : " (use the newer remap that wrote it)"));
}

bool is_of_materials(const Field& root) {
  return root.contains("source") && root["source"].contains("workflow");
}

Range read_range(const Field& field) {
  const Range range{field.at(0, 2).number(), field.at(1, 2).number()};
  field.require(range.min < range.max, "[min, max] with min < max");
  return range;
}

ModelSide read_side(const Field& field) {
  const RoughnessEncoding convention =
      field["roughness"].named(kRoughnessEncodings, "alpha, roughness, exponent, glossiness or squared");
  const std::string specular = field["specular"].text();
  field["specular"].require(is_valid_specular(specular), "an identifier that names no width");
  return {read_model(field["model"]), convention, specular};
}

std::string read_id(const Field& field) {
  const std::string id = field.text();
  field.require(is_valid_id(id), kIdRule);
  return id;
}

std::string read_model(const Field& field) {
  const std::string model = field.text();
  field.require(is_valid_model(model),
                "letters, digits and _ - . /, at most " + std::to_string(kLongestName));
  return model;
}

std::string read_tool_version(const Field& field) {
  const std::string tool = field.text();
  field.require(tool.starts_with("remapc "), "remapc and its version");
  return tool.substr(7);
}

double finite(double value) {
  if (!std::isfinite(value))
    throw numeric_error("fit: a number is not finite; a fit file holds finite numbers only");
  return value;
}

Json side_json(const ModelSide& side) {
  return {{"model", side.model},
          {"roughness", std::string(encoding_name(side.roughness))},
          {"specular", side.specular}};
}

Json domain_json(const ConverterInfo& info) {
  return {{"roughness", {info.roughness.min, info.roughness.max}},
          {"specular", {info.specular.min, info.specular.max}}};
}

Json errors_json(const ConverterInfo& info) {
  const auto json = [](const std::optional<double>& error) { return error ? Json(*error) : Json(); };
  return {{"roughness", json(info.roughness_rms_error)},
          {"specular", json(info.specular_rms_error)},
          {"image", json(info.image_rms_error)}};
}

Json ssim_json(const ConverterInfo& info) { return info.ssim ? Json(*info.ssim) : Json(); }

namespace {

constexpr std::int64_t kFormatVersion = 2;

// Returns the shortest decimal that reads back as this float.
double decimal(float value) { return decimal_value(value); }

Json terms_json(const FactorTerms& factor) {
  Json rows = Json::list();
  for (const std::vector<float>& row : factor) {
    Json numbers = Json::list();
    for (const float term : row) numbers.push_back(decimal(term));
    rows.push_back(std::move(numbers));
  }
  return rows;
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
  const CompactForm& form = data.form;
  std::string text = "{\"id\": " + Json(data.info.id).dump();
  const auto add = [&text](const char* name, const std::string& value) {
    text += ",\n      \"" + std::string(name) + "\": " + value;
  };
  add("source", side_json(data.info.source).dump());
  add("target", side_json(data.info.target).dump());
  add("domain", domain_json(data.info).dump());
  add("rms_error", errors_json(data.info).dump());
  add("ssim", ssim_json(data.info).dump());
  if (const auto& pictures = data.info.pictures)
    add("pictures", Json({{"converted", pictures->converted}, {"copied", *pictures->copied}}).dump());
  add("pole", Json(decimal(form.pole)).dump());
  add("alpha", terms_json(form.alpha).dump());
  add("specular", terms_json(form.specular).dump());
  const auto limit = [](const std::optional<float>& value) { return value ? Json(decimal(*value)) : Json(); };
  const Json limits = {{"alpha", limit(form.alpha_limit)}, {"specular", limit(form.specular_limit)}};
  add("limits", limits.dump());
  const Json hinge = {{"turn", decimal(form.hinge.turn)},
                      {"turn_by_alpha", decimal(form.hinge.turn_by_alpha)},
                      {"bend", decimal(form.hinge.bend)},
                      {"spread", decimal(form.hinge.spread)}};
  add("hinge", hinge.dump());
  const Json within = {{"alpha", finite(data.alpha_bound)}, {"specular", finite(data.specular_bound)}};
  add("within", within.dump());
  add("golden", golden_text(data.golden));
  return text + "}";
}

namespace {

float read_float(const Field& field) {
  const float value = static_cast<float>(field.number());
  field.require(std::isfinite(value), "a number that a float can hold");
  return value;
}

FactorTerms read_terms(const Field& field) {
  FactorTerms factor = field.list(1, [](const Field& row) {
    std::vector<float> numbers = row.list(1, read_float);
    row.require(numbers.size() <= kMostPowersOfAlpha,
                "up to " + std::to_string(kMostPowersOfAlpha) + " powers of alpha");
    return numbers;
  });
  field.require(factor.size() <= kMostPowersOfT,
                "up to " + std::to_string(kMostPowersOfT) + " powers of specular");
  return factor;
}

std::optional<double> read_optional(const Field& field) {
  return field.is_null() ? std::nullopt : std::optional<double>(field.number());
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

CompactForm read_form(const Field& field) {
  CompactForm form;
  form.pole = read_float(field["pole"]);
  field["pole"].require(form.pole > 0.0f, "a number above 0");
  form.alpha = read_terms(field["alpha"]);
  form.specular = read_terms(field["specular"]);
  form.alpha_limit = read_limit(field["limits"]["alpha"]);
  form.specular_limit = read_limit(field["limits"]["specular"]);
  const Field hinge = field["hinge"];
  form.hinge = {read_float(hinge["turn"]), read_float(hinge["turn_by_alpha"]), read_float(hinge["bend"]),
                read_float(hinge["spread"])};
  hinge["bend"].require(form.hinge.bend >= 0.0f, "at least 0");
  return form;
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
  if (field.contains("pictures"))
    data.info.pictures = {field["pictures"]["converted"].number(), field["pictures"]["copied"].number()};
  data.form = read_form(field);
  data.info.is_copy = is_copy(data.form);
  data.alpha_bound = field["within"]["alpha"].number();
  data.specular_bound = field["within"]["specular"].number();
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

std::vector<ConverterData> converters_from_json(std::string_view text, const std::string& context) {
  const Json json = parse_json(text, context);
  const Field root(json, context);
  root["format"].require(root["format"].text() == "remap-converters", "remap-converters");
  root["version"].require(root["version"].count() == kFormatVersion, std::to_string(kFormatVersion));
  return root["converters"].list(0, read_converter);
}

}  // namespace remap
