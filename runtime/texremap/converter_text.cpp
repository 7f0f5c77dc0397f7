#include "texremap/converter_text.hpp"

#include "text/number_text.hpp"

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
  const auto text = [](const std::optional<double>& error) {
    return error ? figure_text(*error) : "unknown";
  };
  const std::string fit = info.roughness_rms_error && info.specular_rms_error
                              ? "rms " + figure_text(*info.roughness_rms_error) + " in alpha and " +
                                    figure_text(*info.specular_rms_error) + " in " + info.target.specular
                              : "unknown";
  return "image " + text(info.image_rms_error) + ", fit " + fit;
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
  const auto json = [](const std::optional<double>& error) { return error ? Json(*error) : Json(); };
  return {{"roughness", json(info.roughness_rms_error)},
          {"specular", json(info.specular_rms_error)},
          {"image", json(info.image_rms_error)}};
}

Json path_json(const ConverterPath& path) {
  Json ids = Json::array();
  for (const Converter* step : path.steps) ids.push_back(step->info().id);
  return ids;
}

}  // namespace remap
