#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "lower/fit_fields.hpp"
#include "lower/fit_file.hpp"
#include "lower/interpreter.hpp"
#include "remap/error.hpp"
#include "stages/warp_json.hpp"

namespace remap {
namespace {

constexpr std::int64_t kLargestPower = 4;  // largest power of specular in a parametric form

Json to_json(const Range& range) { return Json::list({finite(range.min), finite(range.max)}); }

Json to_json(const Parametric& form) {
  Json alpha = Json::list(), specular = Json::list();
  for (const auto& row : form.alpha) alpha.push_back(numbers_json(row));
  for (const auto& [power, curve] : form.specular)
    specular.push_back({{"power", power},
                        {"start", finite(curve.start)},
                        {"ramp", finite(curve.ramp)},
                        {"ramp_rate", finite(curve.ramp_rate)},
                        {"bump", finite(curve.bump)},
                        {"bump_rate", finite(curve.bump_rate)},
                        {"pole", finite(curve.pole)}});
  return {{"alpha", alpha}, {"specular", specular}};
}

Json to_json(const KernelExpansion& expansion) {
  return {{"inputs", scalings_json(expansion.inputs)},  {"output", scaling_json(expansion.output)},
          {"gamma", finite(expansion.gamma)},           {"bias", finite(expansion.bias)},
          {"vectors", numbers_json(expansion.vectors)}, {"weights", numbers_json(expansion.weights)}};
}

Json to_json(const Svr& svr) { return {{"alpha", to_json(svr.alpha)}, {"specular", to_json(svr.specular)}}; }
Json to_json(const Mlp& mlp) {
  return {{"alpha", network_json(mlp.alpha)}, {"specular", network_json(mlp.specular)}};
}

Json to_json(const CompactForm& form) {
  const auto terms = [](const FactorTerms& factor) {
    Json rows = Json::list();
    for (const std::vector<float>& row : factor) {
      Json numbers = Json::list();
      for (const float term : row) numbers.push_back(finite(decimal_value(term)));
      rows.push_back(std::move(numbers));
    }
    return rows;
  };
  const auto limit = [](const std::optional<float>& value) {
    return value ? Json(finite(decimal_value(*value))) : Json();
  };
  return {{"pole", finite(decimal_value(form.pole))},
          {"alpha", terms(form.alpha)},
          {"specular", terms(form.specular)},
          {"alpha_limit", limit(form.alpha_limit)},
          {"specular_limit", limit(form.specular_limit)},
          {"turn", finite(decimal_value(form.hinge.turn))},
          {"turn_by_alpha", finite(decimal_value(form.hinge.turn_by_alpha))},
          {"bend", finite(decimal_value(form.hinge.bend))},
          {"spread", finite(decimal_value(form.hinge.spread))}};
}

Json mapping_json(const MappingKind& mapping) {
  Json json = {{"kind", kind_name(mapping)}};
  json.update(std::visit([](const auto& kind) { return to_json(kind); }, mapping));
  return json;
}

Json to_json(const Limits& limits) {
  return {{"alpha", finite(limits.alpha)},
          {"specular", limits.specular ? Json(finite(*limits.specular)) : Json()}};
}

Json to_json(const PictureErrors& errors) {
  return {{"rmse", finite(errors.rmse)}, {"relative", finite(errors.relative)}};
}

Json to_json(const CandidateRecord& candidate) {
  return {{"name", candidate.name},
          {"number_count", candidate.number_count},
          {"alpha", figures_json(candidate.alpha)},
          {"relative_alpha", finite(candidate.relative_alpha)},
          {"specular", figures_json(candidate.specular)},
          {"relative_specular", finite(candidate.relative_specular)},
          {"pictures", candidate.pictures ? to_json(*candidate.pictures) : Json()},
          {"verdict", candidate.verdict}};
}

Json similarity_json(const Fit& fit) {
  if (!fit.image_error) return nullptr;
  Json spheres = Json::list();
  for (const auto& [alpha, ssim] : fit.ssim)
    spheres.push_back({{"alpha", finite(alpha)}, {"ssim", finite(ssim)}});
  return {{"image_error", figures_json(*fit.image_error)}, {"spheres", spheres}};
}

double read_rate(const Field& field) {
  field.require(field.number() >= 0.0, "a rate from 0");
  return field.number();
}

SpecularTerm read_term(const Field& field) {
  const std::int64_t power = field["power"].count();
  field["power"].require(power <= kLargestPower, "a power from 0 to " + std::to_string(kLargestPower));
  return {static_cast<int>(power),
          {field["start"].number(), field["ramp"].number(), read_rate(field["ramp_rate"]),
           field["bump"].number(), read_rate(field["bump_rate"]), field["pole"].number()}};
}

Parametric read_parametric(const Field& field) {
  Parametric form;
  form.alpha = field["alpha"].list(1, [](const Field& row) { return row.numbers(1); });
  form.specular = field["specular"].list(1, read_term);
  const auto falls = [](const SpecularTerm& a, const SpecularTerm& b) { return a.power > b.power; };
  const bool ordered =
      std::adjacent_find(form.specular.begin(), form.specular.end(), falls) == form.specular.end();
  field["specular"].require(ordered, "terms whose powers do not fall");
  return form;
}

// Reads the inputs of a regressor for one texel: alpha, or alpha and specular.
std::vector<Scaling> read_inputs(const Field& field) {
  const auto inputs = field.list(1, read_scaling);
  field.require(inputs.size() <= 2, "one input (alpha) or two (alpha, specular)");
  return inputs;
}

KernelExpansion read_expansion(const Field& field) {
  KernelExpansion expansion;
  expansion.inputs = read_inputs(field["inputs"]);
  expansion.output = read_output_scaling(field["output"]);
  expansion.gamma = field["gamma"].number();
  field["gamma"].require(expansion.gamma > 0.0, "a gamma above 0");
  expansion.bias = field["bias"].number();
  expansion.weights = field["weights"].numbers(0);
  expansion.vectors = field["vectors"].numbers(0);
  field["vectors"].require(expansion.vectors.size() == expansion.weights.size() * expansion.inputs.size(),
                           "a number for each weight and input");
  return expansion;
}

Network read_texel_network(const Field& field) {
  read_inputs(field["inputs"]);
  return read_network(field, 1);
}

float read_float(const Field& field) {
  const float value = static_cast<float>(field.number());
  field.require(std::isfinite(value), "a number that a float can hold");
  return value;
}

FactorTerms read_terms(const Field& field) {
  return field.list(1, [](const Field& row) { return row.list(1, read_float); });
}

std::optional<double> read_limit(const Field& field) {
  if (field.is_null()) return std::nullopt;
  field.require(field.number() > 0.0, "a number above 0");
  return field.number();
}

CompactForm read_compact(const Field& field) {
  CompactForm form;
  form.pole = read_float(field["pole"]);
  field["pole"].require(form.pole > 0.0f, "a number above 0");
  form.alpha = read_terms(field["alpha"]);
  form.specular = read_terms(field["specular"]);
  const auto limit = [&](const char* name) {
    const std::optional<double> value = read_limit(field[name]);
    return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
  };
  form.alpha_limit = limit("alpha_limit");
  form.specular_limit = limit("specular_limit");
  form.hinge = {read_float(field["turn"]), read_float(field["turn_by_alpha"]), read_float(field["bend"]),
                read_float(field["spread"])};
  field["bend"].require(form.hinge.bend >= 0.0f, "at least 0");
  return form;
}

MappingKind read_mapping(const Field& field) {
  const std::string kind = field["kind"].text();
  if (kind == "compact") return read_compact(field);
  if (kind == "parametric") return read_parametric(field);
  if (kind == "svr") return Svr{read_expansion(field["alpha"]), read_expansion(field["specular"])};
  if (kind == "mlp") {
    const Mlp mlp{read_texel_network(field["alpha"]), read_texel_network(field["specular"])};
    field["specular"]["activation"].require(mlp.alpha.activation == mlp.specular.activation,
                                            "the activation of the other network");
    return mlp;
  }
  field["kind"].require(false, "compact, parametric, svr or mlp");
  return {};
}

Limits read_limits(const Field& field) {
  field["alpha"].require(field["alpha"].number() > 0.0, "a number above 0");
  return {field["alpha"].number(), read_limit(field["specular"])};
}

PictureErrors read_pictures(const Field& field) {
  return {field["rmse"].number(), field["relative"].number()};
}

CandidateRecord read_candidate(const Field& field) {
  const Field pictures = field["pictures"];
  return {field["name"].text(),
          static_cast<std::size_t>(field["number_count"].count()),
          read_figures(field["alpha"]),
          read_figures(field["specular"]),
          field["relative_alpha"].number(),
          field["relative_specular"].number(),
          pictures.is_null() ? std::nullopt : std::optional(read_pictures(pictures)),
          field["verdict"].text()};
}

void read_similarity(const Field& field, Fit* fit) {
  if (field.is_null()) return;
  fit->image_error = read_figures(field["image_error"]);
  field["spheres"].list(0, [&](const Field& entry) {
    fit->ssim.emplace(entry["alpha"].number(), entry["ssim"].number());
    return 0;
  });
}

// Refuses a converter that was made from another fit. Either its models differ, or its golden texels
// contradict the mapping.
void require_own_converter(const Fit& fit, const Field& root) {
  const ConverterInfo& info = fit.converter->info;
  const auto is_near = [](double value, float golden, float within) {
    return std::fabs(value - static_cast<double>(golden)) <= static_cast<double>(within);
  };
  bool is_own = info.id == fit.id && info.source == fit.source && info.target == fit.target;
  for (const GoldenTexel& golden : fit.converter->golden) {
    const auto specular = static_cast<double>(golden.specular);
    double out = 0.0;
    const double width = evaluate_texel(fit, static_cast<double>(golden.width), {&specular, 1}, {&out, 1});
    is_own = is_own && is_near(width, golden.width_out, golden.width_within) &&
             is_near(out, golden.specular_out, golden.specular_within);
  }
  if (!is_own) root["converter"].fail(std::string("does not belong to the mapping (") + kMakeAgain + ")");
}

}  // namespace

std::string fit_to_json(const Fit& fit) {
  if (const std::string fault = oversize(fit); !fault.empty()) throw input_error(fit.id + ": " + fault);
  Json candidates = Json::list();
  for (const CandidateRecord& candidate : fit.candidates) candidates.push_back(to_json(candidate));
  const Json json = {
      {"format", "remap-fit"},
      {"version", kFitFormatVersion},
      {"id", fit.id},
      {"source", side_json(fit.source)},
      {"target", side_json(fit.target)},
      {"domain", {{"alpha", to_json(fit.domain.alpha)}, {"specular", to_json(fit.domain.specular)}}},
      {"mapping", mapping_json(fit.mapping)},
      {"limits", to_json(fit.limits)},
      {"method", fit.method},
      {"candidates", candidates},
      {"error_on_held_out_rows",
       {{"alpha", figures_json(fit.alpha_error)}, {"specular", figures_json(fit.specular_error)}}},
      {"similarity", similarity_json(fit)},
      {"pictures",
       fit.pictures ? Json({{"converted", to_json(*fit.pictures)}, {"copied", to_json(*fit.copied_pictures)}})
                    : Json()},
      {"remarks", fit.remarks},
      {"split", split_json(fit.split)},
      {"table", table_record_json(fit.table)},
      {"tool", "remapc " + fit.tool_version},
  };
  std::string text = json.dump(2);
  text.resize(text.size() - 2);  // drop the newline and the last brace
  return text + ",\n  \"converter\": " + (fit.converter ? converter_to_json(*fit.converter) : "null") +
         "\n}\n";
}

Fit read_fit(const Field& root) {
  Fit fit;
  fit.id = read_id(root["id"]);
  // Read the converter first. Files without a converter are old and lack other fields, too, but the message
  // must be about the converter.
  fit.converter = read_fitted_converter(root);
  fit.source = read_side(root["source"]);
  fit.target = read_side(root["target"]);
  fit.domain = {read_range(root["domain"]["alpha"]), read_range(root["domain"]["specular"])};
  root["domain"]["alpha"].require(fit.domain.alpha.min > 0.0, "an alpha above 0");
  root["domain"]["specular"].require(fit.domain.specular.min >= 0.0, "a range from 0 or more");
  fit.mapping = read_mapping(root["mapping"]);
  fit.limits = read_limits(root["limits"]);
  if (const std::string fault = oversize(fit); !fault.empty()) root.fail(fault);
  fit.method = root["method"].text_dictionary();
  fit.candidates = root["candidates"].list(0, read_candidate);
  fit.alpha_error = read_figures(root["error_on_held_out_rows"]["alpha"]);
  fit.specular_error = read_figures(root["error_on_held_out_rows"]["specular"]);
  read_similarity(root["similarity"], &fit);
  if (const Field pictures = root["pictures"]; !pictures.is_null()) {
    fit.pictures = read_pictures(pictures["converted"]);
    fit.copied_pictures = read_pictures(pictures["copied"]);
  }
  fit.remarks = root["remarks"].texts();
  fit.split = read_split(root["split"]);
  fit.table = read_table_record(root["table"]);
  fit.tool_version = read_tool_version(root["tool"]);
  if (fit.converter) require_own_converter(fit, root);
  return fit;
}

AnyFit any_fit_from_json(std::string_view text, const std::string& context) {
  const Json json = parse_json(text, context);
  const Field root(json, context);
  require_fit_file(root);
  if (!is_of_materials(root)) return read_fit(root);
  if (root["mapping"]["kind"].text() == kWarpKind) return read_warp_fit(root);
  return read_workflow_fit(root);
}

AnyFit load_any_fit(const std::filesystem::path& path) {
  if (path.extension() == ".csv")
    throw Error(ErrorKind::kInput, path.string() + ": is a table, not a fit (remapc fit makes a fit of it)");
  return any_fit_from_json(read_file(path), path.string());
}

const Fit& require_width_and_specular(const AnyFit& fit, ErrorKind kind, const std::string& context) {
  if (const Fit* found = std::get_if<Fit>(&fit)) return *found;
  throw Error(kind, context +
                        ": converts whole materials, but this command needs a fit of roughness and specular "
                        "(use it with remapc list, show and emit)");
}

Fit fit_from_json(std::string_view text, const std::string& context) {
  return require_width_and_specular(any_fit_from_json(text, context), ErrorKind::kInput, context);
}

Fit load_fit(const std::filesystem::path& path) { return fit_from_json(read_file(path), path.string()); }

}  // namespace remap
