#include <algorithm>

#include "core/contains.hpp"
#include "core/number_text.hpp"
#include "texremap/plan/converter_text.hpp"
#include "texremap/report/reporter.hpp"

namespace remap {
namespace {

Json position_json(const std::optional<TexelPosition>& texel) {
  return texel ? Json{texel->x, texel->y} : Json();
}

// Returns the first result for which `holds` returns true, or null.
template <typename Holds>
Json file_json(const JobReport& report, const Holds& holds) {
  const auto found = std::ranges::find_if(report.results, holds);
  return found == report.results.end() ? Json() : Json(found->path.string());
}

Json file_json(const JobReport& report, Parameter parameter) {
  return file_json(report, [parameter](const JobReport::Result& result) {
    return contains(result.parameters, parameter);
  });
}

Json paths_json(const std::vector<std::filesystem::path>& paths) {
  Json names = Json::list();
  for (const std::filesystem::path& path : paths) names.push_back(path.string());
  return names;
}

Json values_json(const ParameterStatistics& statistics, bool histograms) {
  if (statistics.finite_count == 0) return {};
  Json json = {{"min", statistics.min}, {"max", statistics.max}};
  if (histograms) json["histogram"] = statistics.histogram;
  return json;
}

Json end_json(const WorkflowEnd& end) {
  Json json = {{"model", model_of(end)},
               {"workflow", kind_name(end)},
               {"diffuse", diffuse_convention_name(diffuse_of(end))}};
  if (const auto* metallic = std::get_if<MetallicWorkflow>(&end))
    json["dielectric_f0"] = metallic->dielectric_f0;
  return json;
}

Json converter_json(const BuiltConversion& chosen) {
  const ConverterInfo& info = chosen.info();
  Json json = {{"converter", info.id},
               {"path", path_json(chosen.path)},
               {"expected_error", chosen.choice.translation ? Json() : Json(chosen.path.expected_error)},
               {"source", info.source.model},
               {"target", info.target.model},
               {"closest_of", chosen.choice.is_closest ? Json(chosen.choice.renderer) : Json()}};
  json["notes"] = chosen.choice.notes;
  if (chosen.choice.translation) return json;
  json.update(pictures_json(chosen.path, chosen.closer));
  if (!chosen.choice.is_material()) return json;
  json["workflow"] = {{"source", end_json(*chosen.choice.source)},
                      {"target", end_json(*chosen.choice.target)},
                      {"assumptions", chosen.choice.assumptions}};
  return json;
}

// Returns how reliable the computed metallic is.
Json metallic_json(const MetallicStatistics& metallic) {
  if (metallic.texel_count == 0) return {};
  return {{"texels", metallic.texel_count},
          {"rms_residual", metallic.rms_residual()},
          {"largest_residual", metallic.largest_residual},
          {"undetermined", metallic.undetermined.count},
          {"undetermined_dark", metallic.dark.count},
          {"ambiguous", metallic.ambiguous.count},
          {"clamped", metallic.clamped.count},
          {"first",
           {{"undetermined", position_json(metallic.undetermined.first)},
            {"undetermined_dark", position_json(metallic.dark.first)},
            {"ambiguous", position_json(metallic.ambiguous.first)},
            {"clamped", position_json(metallic.clamped.first)}}}};
}

Json f0_json(const std::optional<DielectricF0>& f0) {
  if (!f0) return {};
  return {{"value", f0->f0}, {"residual", f0->residual}, {"is_certain", f0->is_certain}};
}

Json counts_json(const MapStatistics& counts) {
  return {{"texels", counts.texel_count},
          {"out_of_domain", counts.out_of_domain_count},
          {"nan", counts.nan_count},
          {"infinite", counts.infinite_count},
          {"negative", counts.negative_count},
          {"first_bad", position_json(counts.first_bad)},
          {"clipped_values", counts.clipped_count}};
}

Json effect_json(const TranslationEffect& effect) {
  Json values = Json::object();
  for (const SurfaceValue& value : effect.values)
    values[value.name] = value.values.size() == 1 ? Json(value.values.front()) : Json(value.values);
  return {{"constants", values}, {"lost", effect.lost}};
}

// Returns the members that only texture sets have.
Json set_json(const ConvertPlan& plan, const JobReport& report) {
  const BuiltConversion& chosen = plan.sets()->chosen;
  const MapStatistics& counts = report.statistics;
  Json json = {{"tiles", report.tiles}}, values;
  std::vector<Parameter> named = report.effect ? report.effect->written : chosen.converter().targets();
  if (report.effect) json.update(effect_json(*report.effect));
  for (const Parameter parameter : named) json[plain_name(parameter)] = file_json(report, parameter);
  json["mask"] = file_json(report, [](const JobReport::Result& result) { return result.mask; });
  json["left_behind"] = paths_json(report.left_behind);
  if (plan.dry_run) {
    json["plan"] = Json::list();
    for (const PlannedRole& role : report.plan)
      json["plan"].push_back({{"role", role.role},
                              {"input", role.input},
                              {"encoding", role.encoding},
                              {"happens", role.happens},
                              {"output", role.output}});
  }
  json["specular_color_space"] = name_of(kTransfers, report.specular_transfer);
  json.update(counts_json(counts));
  for (const Parameter parameter : chosen.converter().sources())
    if (!report.effect && !contains(named, parameter)) named.push_back(parameter);
  const auto of = [&](const auto& all, Parameter parameter) {
    const auto found = all.find(parameter);
    return found == all.end() ? Json() : values_json(found->second, plan.verbose);
  };
  for (const Parameter parameter : named)
    if (parameter != Parameter::kMetallicIssues)
      values[plain_name(parameter)] = {{"source", of(counts.sources, parameter)},
                                       {"target", of(counts.targets, parameter)}};
  json["values"] = values;
  if (chosen.choice.is_material() && !report.effect) {
    json["masked"] = counts.masked_count;
    json["above_one"] = counts.above_one_count;
    json["metallic_confidence"] = metallic_json(counts.metallic);
    json["estimated_dielectric_f0"] = f0_json(report.estimated_f0);
  }
  json["texels_per_second"] =
      report.seconds > 0.0 ? Json(static_cast<double>(counts.texel_count) / report.seconds) : Json();
  return json;
}

Json material_json(const AssetMaterial& material) {
  Json json = {{"index", material.index},
               {"name", material.name},
               {"state", name_of(kMaterialStates, material.state)}};
  if (material.state == MaterialState::kConverted) {
    json["becomes"] = material.becomes;
    json["expected_error"] = rounded(kPictureOfResidual * material.residual, 3);
  }
  for (const MaterialFactor& factor : material.factors) {
    Json values = Json::list();
    for (const double value : factor.values) values.push_back(value);
    json[factor.name] = factor.values.size() == 1 ? Json(factor.values.front()) : values;
  }
  json["warnings"] = material.warnings;
  json["failure"] = material.failure.empty() ? Json() : Json(material.failure);
  return json;
}

Json colors_json(const ColorNotes& colors) {
  constexpr NamedValues<TransferReason, 3> kReasons = {
      {{TransferReason::kUsual, "usual"}, {TransferReason::kFile, "file"}, {TransferReason::kUser, "user"}}};
  Json notes = Json::list();
  for (const auto& [note, count] : colors)
    notes.push_back({{"color", parameter_name(note.color)},
                     {"use", note.is_written ? "written" : "read"},
                     {"color_space", name_of(kTransfers, note.transfer)},
                     {"reason", name_of(kReasons, note.reason)},
                     {"maps", count}});
  return notes;
}

}  // namespace

ColorNotes Outcome::colors() const {
  ColorNotes all;
  for (const JobReport& report : reports)
    for (const auto& [note, count] : report.colors) all[note] += count;
  return all;
}

std::size_t Outcome::failed_count() const {
  std::size_t count = 0;
  for (const JobReport& report : reports) count += report.failure_text().has_value();
  for (const SkippedEntry& entry : plan.list.skipped) count += entry.is_failure;
  return count;
}

std::string_view state_text(const ConvertPlan& plan, const JobReport& report) {
  if (report.failure_text()) return "failed";
  if (report.was_done) return "done before";
  return plan.dry_run ? "planned" : "converted";
}

Json conversion_json(const ConvertPlan& plan) {
  return plan.sets() != nullptr ? converter_json(plan.sets()->chosen)
                                : Json{{"target", plan.conversion.target}};
}

Json job_json(const ConvertPlan& plan, const JobReport& report) {
  const std::optional<std::string> failure = report.failure_text();
  Json json = {{"name", report.name},
               {"state", state_text(plan, report)},
               {"failure", failure ? Json(*failure) : Json()},
               {"inputs", paths_json(report.inputs)},
               {"results", Json::list()},
               {"copies", paths_json(report.copies)},
               {"warnings", report.warnings},
               {"seconds", report.seconds},
               {"bytes_read", report.bytes_read},
               {"bytes_written", report.bytes_written}};
  for (const JobReport::Result& result : report.results) json["results"].push_back(result.path.string());
  if (plan.sets() != nullptr) {
    json.update(set_json(plan, report));
    return json;
  }
  json["materials"] = Json::list();
  for (const AssetMaterial& material : report.materials) json["materials"].push_back(material_json(material));
  return json;
}

Json run_json(const Outcome& outcome) {
  Json json = {{"seconds", outcome.seconds},
               {"processor_seconds", outcome.used.processor_seconds},
               {"peak_memory_bytes", outcome.used.peak_memory_bytes}};
  if (const SetPlan* sets = outcome.plan.sets()) {
    json["colors"] = colors_json(outcome.colors());
    json["instructions"] = std::string(instruction_set_name(sets->chosen.info().instructions));
  }
  return json;
}

Json summary_json(const Outcome& outcome) {
  std::map<std::string_view, std::size_t> states = {
      {"converted", 0}, {"done before", 0}, {"failed", 0}, {"planned", 0}};
  for (const JobReport& report : outcome.reports) ++states[state_text(outcome.plan, report)];
  const JobList& list = outcome.plan.list;
  Json summary = {{std::string(name_of(kListedKinds, list.kind)), outcome.reports.size()},
                  {"converted", states["converted"]},
                  {"done_before", states["done before"]},
                  {"planned", states["planned"]},
                  {"failed", outcome.failed_count()},
                  {"skipped", list.skipped.size()},
                  {"unrecognised_images", paths_json(list.unrecognised)}};
  summary.update(run_json(outcome));
  return summary;
}

}  // namespace remap
