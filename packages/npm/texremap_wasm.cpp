// This file is the library for JavaScript. One function gets a request as JSON and returns an answer as JSON.
// Another function converts bands of maps. Maps stay in memory, and requests give their places. Only index.js
// writes requests.
#include <cstdint>
#include <emscripten.h>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "converter/converter_data.hpp"
#include "core/errors.hpp"
#include "core/json_field.hpp"
#include "paths/converter_file.hpp"
#include "remap/conversion.hpp"
#include "remap/convert_maps.hpp"
#include "remap/version.hpp"
#include "stages/stage.hpp"

namespace remap {
namespace {

// A HeldConverter is a converter that JavaScript refers to by its number.
struct HeldConverter {
  BuiltConversion conversion;         // by names
  std::unique_ptr<Converter> of_fit;  // from the text of a fit
  // These are the default encodings of the roughness of maps. A converter of materials may use another
  // inside.
  RoughnessEncoding source = RoughnessEncoding::kAlpha, target = RoughnessEncoding::kAlpha;
  const Converter& converter() const { return of_fit ? *of_fit : conversion.converter(); }
};

const ConverterGraph& graph() {
  static const ConverterGraph shipped = shipped_graph();
  return shipped;
}

std::map<std::int64_t, HeldConverter>& held_converters() {
  static std::map<std::int64_t, HeldConverter> held;
  return held;
}

template <typename Value, std::size_t Count>
Value named(const Field& field, const NamedValues<Value, Count>& table) {
  std::string names;
  for (const NamedValue<Value>& entry : table) names += (names.empty() ? "" : ", ") + std::string(entry.name);
  return field.named(table, "one of " + names);
}

template <typename Value, std::size_t Count>
std::optional<Value> named_if(const Field& field, const std::string& key,
                              const NamedValues<Value, Count>& table) {
  if (!field.contains(key) || field[key].is_null()) return std::nullopt;
  return named(field[key], table);
}

Parameter parameter_named(const Field& field) {
  for (std::size_t i = 0; i < kParameterCount; ++i)
    if (plain_name(static_cast<Parameter>(i)) == field.text()) return static_cast<Parameter>(i);
  field.fail("unknown parameter");
}

// Returns a request. Its messages use the names of JavaScript.
ConversionRequest request_of(const Field& field) {
  ConversionRequest request;
  request.source = model_named(field["source"].text());
  request.target = model_named(field["target"].text());
  if (field.contains("via"))
    request.via = field["via"].list(0, [](const Field& model) { return model.text(); });
  if (field.contains("dielectricF0")) request.dielectric_f0 = field["dielectricF0"].number();
  if (field.contains("metallicBias")) request.prior = field["metallicBias"].number();
  request.words.dielectric_f0 = "dielectricF0";
  return request;
}

Json parameters_json(const std::vector<Parameter>& parameters) {
  Json list = Json::list();
  for (const Parameter parameter : parameters)
    list.push_back({{"name", plain_name(parameter)},
                    {"color", is_color(parameter)},
                    {"measure", is_measure(parameter)}});
  return list;
}

Json path_json(const ConverterPath& path) {
  Json steps = Json::list();
  for (const Converter* step : path.steps)
    steps.push_back({{"id", step->info().id}, {"expectedError", expected_error(step->info())}});
  return {{"models", path.steps.empty() ? std::vector<std::string>{} : path_models(path)},
          {"steps", steps},
          {"expectedError", path.expected_error}};
}

Json conversion_json(const HeldConverter& held, const ConverterInfo& domain) {
  const Converter& converter = held.converter();
  const ConverterInfo& info = converter.info();
  return {{"id", info.id},
          {"source", info.source.model},
          {"target", info.target.model},
          {"sourceEncoding", encoding_name(held.source)},
          {"targetEncoding", encoding_name(held.target)},
          {"sources", parameters_json(converter.sources())},
          {"targets", parameters_json(converter.targets())},
          {"domain", domain_json(domain)}};
}

// Opens a converter by names, or from the text of a fit.
Json open_converter(const Field& request) {
  HeldConverter held;
  Json answer;
  if (request.contains("fit")) {
    auto fit = fitted_converter_from_json(request["fit"].any_text(), "fit");
    auto* const data = std::get_if<ConverterData>(&fit);
    if (data == nullptr)
      throw input_error("fit: converts whole materials (give a fit of roughness and specular)");
    held.of_fit = make_converter(*data, best_instruction_set());
    held.source = held.of_fit->info().source.roughness;
    held.target = held.of_fit->info().target.roughness;
    answer = conversion_json(held, held.of_fit->info());
    answer["path"] = Json();
    answer["notes"] = answer["assumptions"] = Json::list();
  } else {
    const ConversionRequest names = request_of(request);
    held.conversion = build_conversion(choose_conversion(names, graph()), names.via, graph());
    const ConversionChoice& choice = held.conversion.choice;
    held.source = held.conversion.source_width();
    held.target = held.conversion.target_width();
    answer = conversion_json(held, held.conversion.domain());
    answer["path"] = path_json(held.conversion.path);
    const auto difference = picture_difference(held.conversion.path);
    answer["path"]["pictureDifference"] = difference ? Json(difference->converted) : Json();
    answer["path"]["closer"] = held.conversion.closer ? Json(target_model(*held.conversion.closer)) : Json();
    answer["notes"] = choice.notes;
    answer["assumptions"] = choice.assumptions;
  }
  static std::int64_t next = 0;
  answer["converter"] = ++next;
  held_converters().emplace(next, std::move(held));
  return answer;
}

Json list_models() {
  Json models = Json::list();
  for (const std::string& name : graph().models()) {
    const ModelSide side = graph().side_of(name);
    models.push_back({{"name", name},
                      {"kind", "brdf"},
                      {"encoding", encoding_name(side.roughness)},
                      {"specular", side.specular}});
  }
  for (const WorkflowModel& model : workflow_models())
    models.push_back({{"name", model_of(model.end)},
                      {"kind", kind_name(model.end)},
                      {"encoding", encoding_name(width_of(model.end))},
                      {"brdf", model.brdf}});
  for (const ModelAlias& alias : model_aliases())
    models.push_back(
        {{"name", alias.name}, {"kind", "alias"}, {"model", alias.model}, {"meaning", alias.meaning}});
  return models;
}

template <typename View>
std::vector<View> views_of(const Field& field) {
  if (!field.contains("channels")) return {};
  return field["channels"].list(0, [](const Field& channel) {
    View view;
    view.first = reinterpret_cast<std::byte*>(static_cast<std::uintptr_t>(channel["at"].count()));
    view.type = named(channel["type"], kPixelTypes);
    view.texel_stride = static_cast<std::ptrdiff_t>(channel["texelStride"].count());
    view.row_stride = static_cast<std::ptrdiff_t>(channel["rowStride"].count());
    return view;
  });
}

SourceParameter source_of(const Field& field) {
  SourceParameter source;
  source.name = field["name"].text();
  source.channels = views_of<ConstChannelView>(field);
  if (field.contains("constants"))
    source.constants =
        field["constants"].list(0, [](const Field& value) { return static_cast<float>(value.number()); });
  source.transfer = named(field["transfer"], kTransfers);
  return source;
}

Json counts_json(const MapStatistics& counts) {
  return {{"texels", counts.texel_count},      {"outOfDomain", counts.out_of_domain_count},
          {"nan", counts.nan_count},           {"infinite", counts.infinite_count},
          {"negative", counts.negative_count}, {"clippedValues", counts.clipped_count},
          {"aboveOne", counts.above_one_count}};
}

// A BegunMaps holds maps that are converted one band of rows at a time. Each band is put into the same
// memory, so one description serves all bands, and also later calls with the same maps.
struct BegunMaps {
  const Converter& converter;
  MapConversion maps;
  MapStatistics counts;
};
std::optional<BegunMaps> begun_maps;

Json begin_maps(const Field& request) {
  begun_maps.reset();
  const auto held = held_converters().find(request["converter"].count());
  if (held == held_converters().end()) throw usage_error("converter: is closed (make another one)");
  MapConversion maps;
  maps.dither = request.flag("dither");
  maps.bad_texels = named_if(request, "badTexels", kBadTexels).value_or(BadTexels::kKeep);
  maps.source_convention =
      named_if(request, "sourceEncoding", kRoughnessEncodings).value_or(held->second.source);
  maps.target_convention =
      named_if(request, "targetEncoding", kRoughnessEncodings).value_or(held->second.target);
  for (const Field& source : request["sources"].list(0, [](const Field& field) { return field; }))
    maps.sources[parameter_named(source["parameter"])] = source_of(source);
  for (const Field& target : request["targets"].list(0, [](const Field& field) { return field; }))
    maps.targets[parameter_named(target["parameter"])] = {views_of<ChannelView>(target),
                                                          named(target["transfer"], kTransfers)};
  begun_maps.emplace(BegunMaps{held->second.converter(), std::move(maps), {}});
  return {};
}

Json close_converter(const Field& request) {
  begun_maps.reset();
  held_converters().erase(request["converter"].count());
  return {};
}

Json end_maps() { return counts_json(std::exchange(begun_maps->counts, {})); }

void convert_band(std::size_t width, std::size_t height, std::size_t first_row) {
  begun_maps->maps.width = width;
  begun_maps->maps.height = height;
  begun_maps->maps.first_row = first_row;
  begun_maps->counts += convert_maps(begun_maps->converter, begun_maps->maps);
}

Json answer_to(const Field& request) {
  const std::string call = request["call"].text();
  if (call == "open") return open_converter(request);
  if (call == "close") return close_converter(request);
  if (call == "begin") return begin_maps(request);
  if (call == "end") return end_maps();
  if (call == "models") return list_models();
  if (call == "version") return kVersion;
  request["call"].fail("unknown call");
}

std::string failure(std::string_view kind, const std::string& message) {
  return Json{{"failure", message}, {"kind", kind}}.dump();
}

// Returns the result of `answer` as text, or null for an empty answer. The text lives until the next call.
template <typename Answer>
const char* answered(const Answer& answer) {
  static std::string text;
  try {
    text = answer();
    return text.empty() ? nullptr : text.c_str();
  } catch (const Error& error) {
    text = failure(name_of(kErrorKinds, error.kind()), error.what());
  } catch (const std::bad_alloc&) {
    text = failure("numeric", "not enough memory (convert fewer texels at a time)");
  } catch (const std::exception& error) {
    text = failure("numeric", error.what());
  }
  return text.c_str();
}

}  // namespace
}  // namespace remap

extern "C" EMSCRIPTEN_KEEPALIVE const char* texremap_call(const char* request) {
  return remap::answered([request] {
    const remap::Json json = remap::parse_json(request, "request");
    return remap::Json{{"answer", remap::answer_to(remap::Field(json, "options"))}}.dump();
  });
}

// Converts a band of the maps that were begun. Returns null, or a failure. It uses no JSON, which would take
// as long as thousands of texels.
extern "C" EMSCRIPTEN_KEEPALIVE const char* texremap_convert_band(std::size_t width, std::size_t height,
                                                                  double first_row) {
  return remap::answered([&] {
    remap::convert_band(width, height, static_cast<std::size_t>(first_row));
    return std::string();
  });
}
