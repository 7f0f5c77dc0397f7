#include "commands/converter_text.hpp"

#include "number_text.hpp"

namespace remap {

std::string range_text(std::string_view name, const Range& range) {
  return std::string(name) + " " + number_text(range.min) + " to " + number_text(range.max);
}

std::string domain_text(const ConverterInfo& info) {
  return range_text(convention_name(info.source.roughness), info.roughness) + ", " +
         range_text(info.source.specular, info.specular);
}

std::string figure_text(double error) { return number_text(rounded_up(error, 2)); }

std::string expected_text(double error) { return number_text(rounded_up(error, 3)); }

std::string errors_text(const ConverterInfo& info) {
  const std::string image = info.image_rms_error ? figure_text(*info.image_rms_error) : "unknown";
  return "image " + image + ", fit rms " + figure_text(info.roughness_rms_error) + " in alpha and " +
         figure_text(info.specular_rms_error) + " in " + info.target.specular;
}

std::string models_text(const ConverterPath& path) {
  std::string text;
  for (const std::string& model : path_models(path)) text += (text.empty() ? "" : " -> ") + model;
  return text;
}

Json side_json(const ModelSide& side) {
  return {{"model", side.model},
          {"roughness", std::string(convention_name(side.roughness))},
          {"specular", side.specular}};
}

Json domain_json(const ConverterInfo& info) {
  return {{"roughness", {info.roughness.min, info.roughness.max}},
          {"specular", {info.specular.min, info.specular.max}}};
}

Json errors_json(const ConverterInfo& info) {
  Json errors = {{"roughness", info.roughness_rms_error}, {"specular", info.specular_rms_error}};
  errors["image"] = info.image_rms_error ? Json(*info.image_rms_error) : Json();
  return errors;
}

Json path_json(const ConverterPath& path) {
  Json ids = Json::array();
  for (const Converter* step : path.steps) ids.push_back(step->info().id);
  return ids;
}

}  // namespace remap
