#include "texremap/converter_text.hpp"

#include "core/number_text.hpp"

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
                              ? ", fit rms " + figure_text(*info.roughness_rms_error) + " in alpha and " +
                                    figure_text(*info.specular_rms_error) + " in " + info.target.specular
                              : "";
  const std::string ssim = info.ssim ? ", SSIM " + number_text(rounded(*info.ssim, 3)) : "";
  return "image " + text(info.image_rms_error) + ssim + fit;
}

std::string models_text(const ConverterPath& path) {
  std::string text;
  for (const std::string& model : path_models(path)) text += (text.empty() ? "" : " -> ") + model;
  return text;
}

std::string ssim_text(const ConverterPath& path) {
  const std::optional<double> ssim = worst_step_ssim(path);
  if (!ssim) return "";
  std::string text = "SSIM " + number_text(rounded(*ssim, 3));
  if (path.steps.size() > 1) text += is_measured(path) ? " in the worst step" : " in the worst step compared";
  return text;
}

std::string closeness_text(const ConverterPath& path, const Closeness& closeness) {
  if (!closeness.looks_different && !closeness.closer) return "";
  const std::string &source = path.steps.front()->info().source.model, &target = target_model(path);
  const std::string error = "expected error " + expected_text(path.expected_error);
  std::string text;
  if (closeness.looks_different) {
    const std::string ssim = ssim_text(path);
    text = target + " will look different from " + source + " (" + error + (ssim.empty() ? "" : ", ") + ssim +
           ")";
  }
  if (!closeness.closer) return text;
  const std::string& closer = target_model(*closeness.closer);
  const std::string closer_error = "expected error " + expected_text(closeness.closer->expected_error);
  if (text.empty())
    return closer + " would look closer to " + source + " than " + target + " (" + closer_error +
           " instead of " + expected_text(path.expected_error) + ")";
  return text + "; " + closer + " would look closer (" + closer_error + ")";
}

std::string closest_text(const std::string& model, double error) {
  return model + " is the closest model of " + renderer_of(model) + " (expected error " +
         expected_text(error) + ")";
}

Json path_json(const ConverterPath& path) {
  Json ids = Json::list();
  for (const Converter* step : path.steps) ids.push_back(step->info().id);
  return ids;
}

Json closeness_json(const ConverterPath& path, const Closeness& closeness) {
  const std::optional<double> ssim = worst_step_ssim(path);
  Json closer;
  if (closeness.closer)
    closer = {{"model", target_model(*closeness.closer)},
              {"path", path_json(*closeness.closer)},
              {"expected_error", closeness.closer->expected_error}};
  return {{"looks_different", path.steps.empty() ? Json() : Json(closeness.looks_different)},
          {"worst_step_ssim", ssim ? Json(*ssim) : Json()},
          {"closer_model", closer}};
}

}  // namespace remap
