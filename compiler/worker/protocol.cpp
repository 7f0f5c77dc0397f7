#include "worker/protocol.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "core/json_field.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "look/scene.hpp"
#include "lower/fit_fields.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// This is the brightest value of a pixel. The peak of the narrowest highlight is below 1e8. The squares of
// values beyond this limit do not fit into floats.
constexpr float kBrightestPixel = 1e18f;

// Filters and differences of sums leave values slightly below 0. They are accepted down to this fraction of
// the brightest value.
constexpr float kNegativeShare = 1e-4f;

// Returns the fault of one value, or null.
const char* rule_against(float value, float least) {
  if (!std::isfinite(value)) return "values must be finite";
  if (value > kBrightestPixel) return "values must not be above 1e18";
  return value < least ? "values must not be negative" : nullptr;
}

// These limit the answer of one renderer, because `remapc renderers` lists all models, and parameters become
// options.
constexpr std::size_t kMostModels = 1000, kMostParameters = 100;

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

Json scene_json(const Scene& scene) {
  const double angle = scene.light.angle * std::numbers::pi / 180.0, distance = scene.light.distance;
  Json json = {
      {"resolution", scene.resolution},
      {"samples_per_axis", scene.samples_per_axis},
      {"camera", {{"distance", kCameraDistance}, {"half_angle", degrees(std::asin(1.0 / kCameraDistance))}}},
      {"light",
       {{"angle", scene.light.angle},
        {"distance", distance},
        {"position", {distance * std::sin(angle), 0.0, distance * std::cos(angle)}},
        {"intensity", 1.0}}}};
  if (scene.environment != nullptr) json["light"] = {{"samples", scene.light_samples}};
  if (scene.shape != Shape::kSphere) json["shape"] = shape_name(scene.shape);
  return json;
}

std::string shown_request(const Material& material, const Scene& scene) {
  std::string text = material.model + " ";
  for (const auto& [name, values] : material.parameters) {
    text += name + " ";
    for (std::size_t i = 0; i < values.size(); ++i) text += (i == 0 ? "" : ":") + number_text(values[i]);
    text += ", ";
  }
  for (const auto& [name, map] : material.maps)
    text += name + " " + std::to_string(map.width) + " x " + std::to_string(map.height) + " texels, ";
  const std::string side = std::to_string(scene.resolution);
  if (scene.environment != nullptr)
    text += "environment";
  else
    text += scene.light.angle == 0.0 ? light_name(scene.light) : "light " + light_name(scene.light);
  if (scene.shape != Shape::kSphere) text += ", " + shape_name(scene.shape);
  return text + ", " + side + " x " + side + (scene.seed == 0 ? "" : ", seed " + std::to_string(scene.seed));
}

ParameterRole read_role(const Field& field) {
  for (const ParameterRole role : kParameterRoles)
    if (field.text() == role_word(role)) return role;
  field.fail("unknown role \"" + field.text() +
             "\" (choose roughness, specular, diffuse, index, extinction or other)");
}

ParameterDescription read_parameter(const Field& field, RoughnessEncoding* convention) {
  ParameterDescription parameter{field["name"].text(), read_role(field["role"]), read_range(field["range"])};
  if (parameter.role == ParameterRole::kRoughness) {
    const auto known = encoding_from_name(field["convention"].text());
    field["convention"].require(known.has_value(), "alpha, roughness, exponent, glossiness or squared");
    *convention = *known;
  }
  if (parameter.role == ParameterRole::kOther) {
    parameter.standard = field["default"].number();
    field["default"].require(parameter.range.contains(parameter.standard), "a number of the range");
  }
  parameter.grey = field.flag("grey");
  return parameter;
}

void require_once(const ModelDescription& model, ParameterRole role, bool needed,
                  const std::string& context) {
  const auto count = std::ranges::count(model.parameters, role, &ParameterDescription::role);
  if (count > 1 || (needed && count == 0))
    throw input_error(context + ": " + std::to_string(count) + " parameters have the role " +
                      std::string(role_word(role)) + " (declare " + (needed ? "one" : "at most one") + ")");
}

ModelDescription read_model(const Field& field, const std::string& prefix) {
  ModelDescription model;
  model.name = field["name"].line();
  const std::size_t slash = model.name.find('/');
  const bool named = slash != std::string::npos && slash != 0 && slash + 1 < model.name.size();
  if (!named || (!prefix.empty() && model.name.substr(0, slash) != prefix))
    field["name"].fail("is \"" + model.name + "\" (must be " + (prefix.empty() ? "PREFIX" : prefix) +
                       "/MODEL)");
  const Field parameters = field["parameters"];
  model.parameters = parameters.list(
      1, [&](const Field& parameter) { return read_parameter(parameter, &model.roughness); },
      kMostParameters);
  require_once(model, ParameterRole::kRoughness, true, model.name);
  require_once(model, ParameterRole::kSpecular, true, model.name);
  require_once(model, ParameterRole::kDiffuse, false, model.name);
  model.alpha = canonical_widths(model.roughness, model.parameter(ParameterRole::kRoughness).range);
  if (!(model.alpha.min >= 0.0) || !(model.alpha.max > 0.0) || !std::isfinite(model.alpha.max))
    throw input_error(model.name + ": the range of its roughness does not fit its convention");
  if (field.contains("precision")) {
    model.precision = field["precision"].number();
    field["precision"].require(model.precision >= 0.0 && model.precision < 0.1, "a number from 0 to 0.1");
  }
  model.is_external = true;  // a worker is another process and uses files
  model.noise = field.flag("noise");
  model.textures = field.flag("textures");
  return model;
}

// Parses an answer, which must have the id of the request. The message for invalid JSON quotes the line.
Json parse_answer(const std::string& line, std::int64_t id, const std::string& context) {
  const std::string answered = context + ": answered \"" + plain(line, 80) + "\"";
  Json answer;
  try {
    answer = parse_json(line, "JSON");
  } catch (const Error& error) {
    throw input_error(answered + ", which is not a line of JSON (" + error.what() + ")");
  }
  if (answer.fields() == nullptr) throw input_error(answered + ", which is not an object");
  if (const Json* own = answer.find("id"); own == nullptr || own->whole() != id)
    throw input_error(answered + " without the id " + std::to_string(id) + " of the request");
  return answer;
}

// Returns the error text of the worker, on one line and truncated.
std::optional<std::string> complaint_of(const Json& answer, const std::string& context) {
  if (!answer.contains("error")) return std::nullopt;
  std::string complaint = Field(answer, context)["error"].any_text();
  std::ranges::replace(complaint, '\n', ' ');
  return plain(complaint);
}

}  // namespace

std::string picture_fault(const Image& image) {
  const auto found = std::ranges::max_element(image.values);
  const float least = found != image.values.end() && *found > 0.0f ? -kNegativeShare * *found : 0.0f;
  const auto channels = static_cast<std::size_t>(image.channels),
             width = static_cast<std::size_t>(image.width);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const char* rule = rule_against(image.values[i], least);
    if (rule == nullptr) continue;
    const std::size_t pixel = i / channels;
    return "the picture is " + number_text(decimal_value(image.values[i])) + " in row " +
           std::to_string(pixel / width) + ", column " + std::to_string(pixel % width) + " (" + rule + ")";
  }
  return "";
}

PictureRequest picture_request(const Material& material, const Scene& scene) {
  PictureRequest request{"", shown_request(material, scene), scene.resolution, scene.shape, 1};
  Json parameters = Json::object();
  for (const auto& [name, values] : material.parameters) {
    parameters[name] = values;
    if (values.size() > 1) request.channels = 3;
  }
  for (const auto& [name, map] : material.maps) request.maps[name] = &map;
  if (scene.environment != nullptr) request.maps[""] = scene.environment;
  if (!request.maps.empty()) request.channels = 3;
  const Json json = {{"model", material.model},
                     {"parameters", parameters},
                     {"scene", scene_json(scene)},
                     {"seed", scene.seed},
                     {"channels", request.channels}};
  request.text = json.dump();
  return request;
}

std::string describe_line(std::int64_t id, unsigned threads) {
  const Json json = {
      {"id", id}, {"request", "describe"}, {"protocol", kWorkerProtocol}, {"threads", threads}};
  return json.dump();
}

std::string render_line(std::int64_t id, const PictureRequest& request, const std::filesystem::path& image,
                        const std::filesystem::path& mesh, const std::vector<std::filesystem::path>& maps) {
  Json json = {{"id", id}, {"request", "render"}};
  json.update(parse_json(request.text, "request"));
  auto file = maps.begin();
  for (const auto& [name, map] : request.maps) {
    Json& place = name.empty() ? json["scene"]["light"] : json["parameters"][name];
    place[name.empty() ? "environment" : "map"] = (file++)->string();
    place["width"] = map->width;
    place["height"] = map->height;
    if (!name.empty()) place["channels"] = map->channels;
  }
  if (request.shape != Shape::kSphere) json["scene"]["mesh"] = mesh.string();
  json["image"] = image.string();
  return json.dump();
}

std::string quit_line(std::int64_t id) { return Json{{"id", id}, {"request", "quit"}}.dump(); }

bool is_answer(const std::string& line) { return line.starts_with('{'); }

std::optional<std::string> read_answer(const std::string& line, std::int64_t id, const std::string& context) {
  return complaint_of(parse_answer(line, id, context), context);
}

WorkerDescription read_description(const std::string& line, std::int64_t id, const std::string& prefix,
                                   const std::string& context) {
  const Json answer = parse_answer(line, id, context);
  if (const auto complaint = complaint_of(answer, context)) throw input_error(context + ": " + *complaint);
  const Field field(answer, context);
  if (field["protocol"].count() != kWorkerProtocol)
    field["protocol"].fail("is version " + field["protocol"].json().dump() + " (must be " +
                           std::to_string(kWorkerProtocol) + ")");
  WorkerDescription description;
  description.renderer = field["renderer"].text();
  field["renderer"].require(!description.renderer.empty(), "a name and a version");
  description.meshes = field.flag("meshes");
  description.models = field["models"].list(
      1, [&](const Field& model) { return read_model(model, prefix); }, kMostModels);
  return description;
}

}  // namespace remap
