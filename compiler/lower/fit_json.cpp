#include <algorithm>
#include <cmath>

#include "core/files.hpp"
#include "core/json.hpp"
#include "lower/fit_fields.hpp"
#include "lower/fit_file.hpp"
#include "lower/interpreter.hpp"
#include "lower/limits.hpp"
#include "remap/error.hpp"
#include "stages/warp_json.hpp"

namespace remap {
namespace {

constexpr std::int64_t kLargestPower = 4;  // of specular, in a parametric form

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

Json to_json(const TexelSeries& series) {
  Json rows = Json::list();
  for (const auto& row : series.coefficients) rows.push_back(numbers_json(row));
  return {{"alpha", to_json(series.alpha)}, {"specular", to_json(series.specular)}, {"coefficients", rows}};
}

Json to_json(const Series& series) {
  return {{"alpha", to_json(series.alpha)}, {"specular", to_json(series.specular)}};
}

// A mapping with its kind.
Json mapping_json(const MappingKind& mapping);

Json to_json(const Chain& chain) {
  Json steps = Json::list();
  for (const auto& [id, mapping] : chain.steps)
    steps.push_back({{"id", id}, {"mapping", mapping_json(widened(mapping))}});
  return {{"steps", steps}};
}

Json mapping_json(const MappingKind& mapping) {
  Json json = {{"kind", kind_name(mapping)}};
  json.update(std::visit([](const auto& kind) { return to_json(kind); }, mapping));
  return json;
}

Json to_json(const Regimes& regimes) {
  Json json = {{"alpha_limit", finite(regimes.alpha_limit)},
               {"specular_limit", regimes.specular_limit ? Json(finite(*regimes.specular_limit)) : Json()}};
  if (regimes.wide)
    json["wide"] = {{"mapping_to", finite(regimes.wide->mapping_to)},
                    {"specular", to_json(regimes.wide->specular)}};
  if (regimes.bright) json["bright"] = {{"alpha", to_json(*regimes.bright)}};
  return json;
}

Json to_json(const RelativeError& error) {
  return {{"rms", finite(error.rms)}, {"standard_error", finite(error.standard_error)}};
}

Json to_json(const CandidateRecord& candidate) {
  return {{"name", candidate.name},
          {"number_count", candidate.number_count},
          {"alpha", figures_json(candidate.alpha)},
          {"relative_alpha", to_json(candidate.relative_alpha)},
          {"specular", figures_json(candidate.specular)},
          {"relative_specular", to_json(candidate.relative_specular)},
          {"edge_alpha_rms", finite(candidate.edge_alpha_rms)},
          {"edge_specular_rms", finite(candidate.edge_specular_rms)},
          {"raw_edge_alpha_rms", finite(candidate.raw_edge_alpha_rms)},
          {"raw_edge_specular_rms", finite(candidate.raw_edge_specular_rms)},
          {"chroma_shift", finite(candidate.chroma_shift)},
          {"verdict", candidate.verdict}};
}

Json to_json(const std::optional<ImageSimilarity>& image_similarity) {
  if (!image_similarity) return nullptr;
  Json spheres = Json::list();
  for (const auto& [alpha, ssim] : image_similarity->ssim)
    spheres.push_back({{"alpha", finite(alpha)}, {"ssim", finite(ssim)}});
  return {{"image_error", figures_json(image_similarity->image_error)}, {"spheres", spheres}};
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

// Inputs of a regressor over one texel: alpha, or alpha and specular.
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

TexelSeries read_series(const Field& field) {
  return {read_range(field["alpha"]), read_range(field["specular"]),
          field["coefficients"].list(1, [](const Field& row) { return row.numbers(1); })};
}

RegressedKind read_regressed(const Field& field) {
  const std::string kind = field["kind"].text();
  if (kind == "parametric") return read_parametric(field);
  if (kind == "svr") return Svr{read_expansion(field["alpha"]), read_expansion(field["specular"])};
  if (kind == "mlp") {
    const Mlp mlp{read_texel_network(field["alpha"]), read_texel_network(field["specular"])};
    field["specular"]["activation"].require(mlp.alpha.activation == mlp.specular.activation,
                                            "the activation of the other network");
    return mlp;
  }
  if (kind == "series") return Series{read_series(field["alpha"]), read_series(field["specular"])};
  field["kind"].require(false, "parametric, svr, mlp or series");
  return {};
}

MappingKind read_mapping(const Field& field) {
  if (field["kind"].text() != "chain") return widened(read_regressed(field));
  return Chain{field["steps"].list(1, [](const Field& step) {
    const std::string id = step["id"].text();
    step["id"].require(is_valid_id(id), "the id of a fit");
    return ChainStep{id, read_regressed(step["mapping"])};
  })};
}

double read_positive(const Field& field) {
  field.require(field.number() > 0.0, "a number above 0");
  return field.number();
}

Regimes read_regimes(const Field& field) {
  Regimes regimes;
  regimes.alpha_limit = read_positive(field["alpha_limit"]);
  if (!field["specular_limit"].is_null()) regimes.specular_limit = read_positive(field["specular_limit"]);
  if (field.contains("wide"))
    regimes.wide = {read_positive(field["wide"]["mapping_to"]), read_series(field["wide"]["specular"])};
  if (field.contains("bright")) {
    field.require(regimes.specular_limit.has_value(), "a specular_limit beside the regime bright");
    regimes.bright = read_series(field["bright"]["alpha"]);
  }
  return regimes;
}

// Fits of 0.1.0 have none.
RelativeError read_relative(const Field& candidate, const std::string& name) {
  if (!candidate.contains(name)) return {};
  return {candidate[name]["rms"].number(), candidate[name]["standard_error"].number()};
}

CandidateRecord read_candidate(const Field& field) {
  return {field["name"].text(),
          static_cast<std::size_t>(field["number_count"].count()),
          read_figures(field["alpha"]),
          read_figures(field["specular"]),
          read_relative(field, "relative_alpha"),
          read_relative(field, "relative_specular"),
          field["edge_alpha_rms"].number(),
          field["edge_specular_rms"].number(),
          field["raw_edge_alpha_rms"].number(),
          field["raw_edge_specular_rms"].number(),
          field["chroma_shift"].number(),
          field["verdict"].text()};
}

std::optional<ImageSimilarity> read_similarity(const Field& field) {
  if (field.is_null()) return std::nullopt;
  return ImageSimilarity{read_figures(field["image_error"]), field["spheres"].list(0, [](const Field& entry) {
                           return SphereSimilarity{entry["alpha"].number(), entry["ssim"].number()};
                         })};
}

// Refuses a converter of another fit: it has other ends, or its golden texels are not what the mapping gives.
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
  if (const std::string fault = oversize(fit); !fault.empty())
    throw Error(ErrorKind::kInput, fit.id + ": " + fault);
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
      {"regimes", to_json(fit.regimes)},
      {"method", fit.method},
      {"candidates", candidates},
      {"error_on_held_out_rows",
       {{"alpha", figures_json(fit.alpha_error)}, {"specular", figures_json(fit.specular_error)}}},
      {"similarity", to_json(fit.image_similarity)},
      {"remarks", fit.remarks},
      {"split", split_json(fit.split)},
      {"table", table_record_json(fit.table)},
      {"tool", "remapc " + fit.tool_version},
  };
  std::string text = json.dump(2);
  text.resize(text.size() - 2);  // without the newline and the brace at its end
  return text + ",\n  \"converter\": " + (fit.converter ? converter_to_json(*fit.converter) : "null") +
         "\n}\n";
}

Fit read_fit(const Field& root) {
  Fit fit;
  fit.id = read_id(root["id"]);
  fit.converter = read_fitted_converter(root);  // first: older files lack other fields, too
  fit.source = read_side(root["source"]);
  fit.target = read_side(root["target"]);
  fit.domain = {read_range(root["domain"]["alpha"]), read_range(root["domain"]["specular"])};
  root["domain"]["alpha"].require(fit.domain.alpha.min > 0.0, "an alpha above 0");
  root["domain"]["specular"].require(fit.domain.specular.min == 0.0, "a range from 0");
  fit.mapping = read_mapping(root["mapping"]);
  if (root.contains("regimes")) fit.regimes = read_regimes(root["regimes"]);
  if (const std::string fault = oversize(fit); !fault.empty()) root.fail(fault);
  fit.method = root["method"].text_dictionary();
  fit.candidates = root["candidates"].list(0, read_candidate);
  fit.alpha_error = read_figures(root["error_on_held_out_rows"]["alpha"]);
  fit.specular_error = read_figures(root["error_on_held_out_rows"]["specular"]);
  fit.image_similarity = read_similarity(root["similarity"]);
  fit.remarks = root["remarks"].texts();
  fit.split = read_split(root["split"]);
  fit.table = read_table_record(root["table"]);
  fit.tool_version = read_tool_version(root["tool"]);
  if (fit.converter) require_own_converter(fit, root);
  return fit;
}

AnyFit any_fit_from_json(std::string_view text, const std::string& place) {
  const Json json = parse_json(text, place);
  const Field root(json, place);
  require_fit_file(root);
  if (!is_of_materials(root)) return read_fit(root);
  if (root["mapping"]["kind"].text() == kWarpKind) return read_warp_fit(root);
  return read_workflow_fit(root);
}

AnyFit load_any_fit(const std::filesystem::path& path) {
  return any_fit_from_json(read_file(path), path.string());
}

const Fit& require_width_and_specular(const AnyFit& fit, ErrorKind kind, const std::string& place) {
  if (const Fit* found = std::get_if<Fit>(&fit)) return *found;
  throw Error(kind, place +
                        ": converts whole materials, but this needs a fit of roughness and specular "
                        "(fits of materials can be listed, shown and emitted)");
}

Fit fit_from_json(std::string_view text, const std::string& place) {
  return require_width_and_specular(any_fit_from_json(text, place), ErrorKind::kInput, place);
}

Fit load_fit(const std::filesystem::path& path) { return fit_from_json(read_file(path), path.string()); }

}  // namespace remap
