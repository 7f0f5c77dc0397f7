#include "model/fit_json.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "error.hpp"
#include "files.hpp"

namespace remap {
namespace {

using Json = nlohmann::ordered_json;

double finite(double value) {
  if (!std::isfinite(value))
    throw Error(ErrorKind::kNumeric, "fit: a number is not finite; a fit file holds finite numbers only");
  return value;
}

Json to_json(const Range& range) { return Json::array({finite(range.min), finite(range.max)}); }

Json to_json(const ModelSide& side) {
  return {{"model", side.model},
          {"roughness", std::string(convention_name(side.roughness))},
          {"specular", side.specular}};
}

Json to_json(const ErrorFigures& figures) {
  return {{"rms", finite(figures.rms)}, {"p99", finite(figures.p99)}, {"max", finite(figures.max)}};
}

Json to_json(const Parametric& form) {
  Json roughness = Json::array();
  for (const double coefficient : form.roughness) roughness.push_back(finite(coefficient));
  return {{"roughness", roughness},
          {"slope",
           {{"start", finite(form.start)},
            {"ramp", finite(form.ramp)},
            {"ramp_rate", finite(form.ramp_rate)},
            {"bump", finite(form.bump)},
            {"bump_rate", finite(form.bump_rate)}}}};
}

// A JSON value with the place it came from, so that every complaint says where.
class Field {
 public:
  Field(const Json& value, std::string place) : value_(value), place_(std::move(place)) {}

  Field operator[](const std::string& key) const {
    require(value_.is_object(), "an object");
    const auto found = value_.find(key);
    if (found == value_.end()) fail("has no field \"" + key + "\"");
    return Field(*found, place_ + "." + key);
  }
  Field at(std::size_t index, std::size_t count) const {
    require(value_.is_array() && value_.size() == count, "a list of " + std::to_string(count));
    return Field(value_[index], place_ + "[" + std::to_string(index) + "]");
  }
  std::string text() const {
    require(value_.is_string(), "a text");
    const std::string text = value_.get<std::string>();
    const bool one_line = std::none_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; });
    require(one_line, "a text of one line");  // it may become a comment in generated code
    return text;
  }
  double number() const {
    require(value_.is_number(), "a number");
    const double number = value_.get<double>();
    require(std::isfinite(number), "a finite number");
    return number;
  }
  std::int64_t count() const {
    require(value_.is_number_integer() && value_.get<std::int64_t>() >= 0, "a whole number from 0");
    return value_.get<std::int64_t>();
  }
  template <typename Value, typename Read>
  std::map<std::string, Value> dictionary(Read read) const {
    require(value_.is_object(), "an object");
    std::map<std::string, Value> entries;
    for (const auto& [key, value] : value_.items()) entries[key] = read(Field(value, place_ + "." + key));
    return entries;
  }
  void require(bool condition, const std::string& expected) const {
    if (!condition) fail("is " + excerpt() + "; expected " + expected);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::kInput, place_ + ": " + what);
  }

 private:
  std::string excerpt() const {
    const std::string text = value_.dump();
    return text.size() > 40 ? text.substr(0, 37) + "..." : text;
  }
  const Json& value_;
  std::string place_;
};

Range read_range(const Field& field) {
  const Range range{field.at(0, 2).number(), field.at(1, 2).number()};
  field.require(range.min < range.max, "[min, max] with min < max");
  return range;
}

ModelSide read_side(const Field& field) {
  const std::string name = field["roughness"].text();
  const auto convention = convention_from_name(name);
  field["roughness"].require(convention.has_value(), "alpha, roughness, exponent or glossiness");
  const std::string specular = field["specular"].text();
  field["specular"].require(is_valid_specular(specular), "an identifier that names no width");
  const std::string model = field["model"].text();
  field["model"].require(is_valid_model(model), "letters, digits and _ - . /");
  return {model, *convention, specular};
}

ErrorFigures read_figures(const Field& field) {
  return {field["rms"].number(), field["p99"].number(), field["max"].number()};
}

Parametric read_parametric(const Field& field) {
  Parametric form;
  const Field roughness = field["roughness"];
  for (std::size_t i = 0; i < form.roughness.size(); ++i)
    form.roughness[i] = roughness.at(i, form.roughness.size()).number();
  const Field slope = field["slope"];
  form.start = slope["start"].number();
  form.ramp = slope["ramp"].number();
  form.ramp_rate = slope["ramp_rate"].number();
  form.bump = slope["bump"].number();
  form.bump_rate = slope["bump_rate"].number();
  slope["ramp_rate"].require(form.ramp_rate >= 0.0, "a rate from 0");
  slope["bump_rate"].require(form.bump_rate >= 0.0, "a rate from 0");
  return form;
}

MappingKind read_mapping(const Field& field) {
  const std::string kind = field["kind"].text();
  field["kind"].require(kind == "parametric", "parametric (this version knows no other kind)");
  return read_parametric(field);
}

Split read_split(const Field& field) {
  Split split;
  split.seed = static_cast<std::uint64_t>(field["seed"].count());
  split.held_out_fraction = field["held_out_fraction"].number();
  split.trained_rows = field["trained_rows"].count();
  split.held_out_rows = field["held_out_rows"].count();
  split.left_out =
      field["left_out"].dictionary<std::int64_t>([](const Field& entry) { return entry.count(); });
  return split;
}

}  // namespace

std::string fit_to_json(const Fit& fit) {
  Json mapping = {{"kind", kind_name(fit.mapping)}};
  mapping.update(std::visit([](const auto& form) { return to_json(form); }, fit.mapping));
  const Json json = {
      {"format", "remap-fit"},
      {"version", kFitFormatVersion},
      {"id", fit.id},
      {"source", to_json(fit.source)},
      {"target", to_json(fit.target)},
      {"domain", {{"alpha", to_json(fit.domain.alpha)}, {"specular", to_json(fit.domain.specular)}}},
      {"mapping", mapping},
      {"error_on_held_out_rows",
       {{"alpha", to_json(fit.roughness_error)}, {"specular", to_json(fit.specular_error)}}},
      {"split",
       {{"seed", fit.split.seed},
        {"held_out_fraction", finite(fit.split.held_out_fraction)},
        {"trained_rows", fit.split.trained_rows},
        {"held_out_rows", fit.split.held_out_rows},
        {"left_out", fit.split.left_out}}},
      {"table", {{"name", fit.table.name}, {"sha256", fit.table.sha256}, {"comments", fit.table.comments}}},
      {"tool", "remapc " + fit.tool_version},
  };
  return json.dump(2) + "\n";
}

Fit fit_from_json(std::string_view text, const std::string& place) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& failure) {
    throw Error(ErrorKind::kInput, place + ": is no JSON: " + failure.what());
  }
  const Field root(json, place);
  if (root["format"].text() != "remap-fit") root.fail("is no fit file; expected \"format\": \"remap-fit\"");
  const std::int64_t version = root["version"].count();
  if (version != kFitFormatVersion)
    root.fail("has format version " + std::to_string(version) + "; this program reads version " +
              std::to_string(kFitFormatVersion));

  Fit fit;
  fit.id = root["id"].text();
  root["id"].require(is_valid_id(fit.id), "a C++ identifier without leading or doubled underscore");
  fit.source = read_side(root["source"]);
  fit.target = read_side(root["target"]);
  fit.domain = {read_range(root["domain"]["alpha"]), read_range(root["domain"]["specular"])};
  root["domain"]["alpha"].require(fit.domain.alpha.min > 0.0, "an alpha above 0");
  root["domain"]["specular"].require(fit.domain.specular.min == 0.0,
                                     "a range from 0: every mapping takes 0 to 0");
  fit.mapping = read_mapping(root["mapping"]);
  fit.roughness_error = read_figures(root["error_on_held_out_rows"]["alpha"]);
  fit.specular_error = read_figures(root["error_on_held_out_rows"]["specular"]);
  fit.split = read_split(root["split"]);
  const Field table = root["table"];
  fit.table.name = table["name"].text();
  fit.table.sha256 = table["sha256"].text();
  fit.table.comments =
      table["comments"].dictionary<std::string>([](const Field& entry) { return entry.text(); });
  const std::string tool = root["tool"].text();
  root["tool"].require(tool.starts_with("remapc "), "remapc and its version");
  fit.tool_version = tool.substr(7);
  return fit;
}

Fit load_fit(const std::filesystem::path& path) { return fit_from_json(read_file(path), path.string()); }

}  // namespace remap
