// Builds a fit from a description and two model files.
#include "fit/svr/svr_import.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "fit/svr/svm_model_file.hpp"
#include "remap/fit_file.hpp"
#include "remap/version.hpp"
#include "system/files.hpp"
#include "text/errors.hpp"
#include "text/json_field.hpp"

namespace remapc {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& place, const std::string& what) {
  throw input_error(remap::plain(place + ": " + what));
}

// Requires an object with exactly the fields `names`; fields of `optional` may be missing.
void require_fields(const Json& json, const std::string& place, const std::vector<std::string>& names,
                    const std::vector<std::string>& optional = {}) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  if (!json.is_object()) fail(place, "must be an object with the fields " + list);
  for (const auto& [key, value] : json.items())
    if (std::find(names.begin(), names.end(), key) == names.end() &&
        std::find(optional.begin(), optional.end(), key) == optional.end())
      fail(place, "unknown field \"" + key + "\" (known: " + list + ")");
  for (const std::string& name : names)
    if (!json.contains(name)) fail(place, "missing field \"" + name + "\" (required: " + list + ")");
}

std::string text_of(const Json& json, const std::string& place) {
  if (!json.is_string()) fail(place, "must be a string");
  return json.get<std::string>();
}

double number_of(const Json& json, const std::string& place) {
  if (!json.is_number() || !std::isfinite(json.get<double>())) fail(place, "must be a finite number");
  return json.get<double>();
}

remap::Scaling scaling_of(const Json& json, const std::string& place) {
  const remap::Scaling scaling{number_of(json["offset"], place + ".offset"),
                               number_of(json["scale"], place + ".scale")};
  if (scaling.scale == 0.0) fail(place + ".scale", "must not be 0");
  return scaling;
}

struct Input {
  std::string name;
  remap::Scaling scaling;
};

std::vector<Input> inputs_of(const Json& json, const std::string& place) {
  if (!json.is_array() || json.empty() || json.size() > 2)
    fail(place, "must be a list of alpha, or of alpha and specular");
  std::vector<Input> inputs;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const std::string here = place + "[" + std::to_string(i) + "]";
    require_fields(json[i], here, {"name", "offset", "scale"});
    const std::string name = text_of(json[i]["name"], here + ".name");
    if (name != "alpha" && name != "specular")
      fail(here + ".name", "unknown input \"" + name + "\" (use alpha or specular)");
    inputs.push_back({name, scaling_of(json[i], here)});
  }
  const auto is_alpha = [](const Input& input) { return input.name == "alpha"; };
  if (std::count_if(inputs.begin(), inputs.end(), is_alpha) != 1) fail(place, "must contain alpha once");
  return inputs;
}

remap::KernelExpansion output_of(const Json& json, const std::filesystem::path& folder,
                                 const std::string& place) {
  require_fields(json, place, {"model_file", "inputs", "output"});
  require_fields(json["output"], place + ".output", {"offset", "scale"});
  const std::filesystem::path file = text_of(json["model_file"], place + ".model_file");
  const std::vector<Input> inputs = inputs_of(json["inputs"], place + ".inputs");
  remap::KernelExpansion expansion = read_svm_model(folder / file, inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) expansion.inputs[i] = inputs[i].scaling;
  expansion.output = scaling_of(json["output"], place + ".output");
  if (inputs.front().name == "specular") {  // in a fit, alpha comes first
    std::swap(expansion.inputs[0], expansion.inputs[1]);
    for (std::size_t i = 0; i < expansion.vectors.size(); i += 2)
      std::swap(expansion.vectors[i], expansion.vectors[i + 1]);
  }
  return expansion;
}

// The reader of fit files parses and checks models, domain and id.
remap::Fit fit_around(const Json& description, const std::string& place) {
  remap::Fit blank;
  blank.id = "blank";
  blank.mapping = remap::Svr{{{{}}, {}, 1.0, 0.0, {}, {}}, {{{}}, {}, 1.0, 0.0, {}, {}}};
  blank.tool_version = remap::kVersion;
  Json json = remap::parse_json(remap::fit_to_json(blank), place);
  for (const auto& [key, value] : description.items())
    if (key != "alpha" && key != "specular") json[key] = value;
  remap::Fit fit = remap::fit_from_json(json.dump(), place);
  if (!description.contains("id")) fit.id = remap::converter_id(fit.source.model, fit.target.model);
  return fit;
}

}  // namespace

remap::Fit import_svr(const std::filesystem::path& path) {
  const std::string place = path.string();
  Json json = remap::parse_json(remap::read_file(path), place);
  require_fields(json, place, {"source", "target", "domain", "alpha", "specular"}, {"id"});
  remap::Fit fit = fit_around(json, place);
  remap::Svr svr;
  svr.alpha = output_of(json["alpha"], path.parent_path(), place + ".alpha");
  svr.specular = output_of(json["specular"], path.parent_path(), place + ".specular");
  fit.method["imported"] = "libsvm model files; errors are not known";
  for (const auto& [name, expansion] :
       {std::pair("alpha.vectors", &svr.alpha), std::pair("specular.vectors", &svr.specular)})
    fit.method[name] = std::to_string(expansion->count());
  fit.mapping = std::move(svr);
  fit.table.name = path.filename().string();
  return fit;
}

}  // namespace remapc
