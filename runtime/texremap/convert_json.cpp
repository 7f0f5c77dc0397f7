// The JSON of `texremap convert --json`, and the printed values of a conversion without maps.
#include <algorithm>
#include <iomanip>
#include <iostream>

#include "texremap/convert_report.hpp"
#include "texremap/converter_text.hpp"

namespace remap {
namespace {

Json position_json(const std::optional<TexelPosition>& texel) {
  return texel ? Json{texel->x, texel->y} : Json();
}

// The first result that `holds` accepts; null without one.
template <typename Holds>
Json file_json(const JobReport& report, const Holds& holds) {
  const auto found = std::find_if(report.results.begin(), report.results.end(), holds);
  return found == report.results.end() ? Json() : Json(found->path.string());
}

Json file_json(const JobReport& report, Parameter parameter) {
  return file_json(report, [parameter](const JobReport::Result& result) {
    return std::find(result.parameters.begin(), result.parameters.end(), parameter) !=
           result.parameters.end();
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

Json converter_json(const ChosenConverter& chosen) {
  const ConverterInfo& info = chosen.info();
  Json json = {{"converter", info.id},
               {"path", path_json(chosen.path)},
               {"expected_error", chosen.path.expected_error},
               {"source", info.source.model},
               {"target", info.target.model},
               {"closest_of", chosen.workflow.is_closest ? Json(chosen.workflow.renderer) : Json()}};
  json["notes"] = chosen.workflow.notes;
  json.update(pictures_json(chosen.path, chosen.closer));
  if (!chosen.workflow.is_material()) return json;
  json["workflow"] = {{"source", end_json(*chosen.workflow.source)},
                      {"target", end_json(*chosen.workflow.target)},
                      {"assumptions", chosen.workflow.assumptions}};
  return json;
}

// The reliability of the metallic that was found.
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

// File names need not be UTF-8.
void print(const Json& json, int indent = 2) { std::cout << json.dump(indent) << std::endl; }

Json counts_json(const MapStatistics& counts) {
  return {{"texels", counts.texel_count},
          {"out_of_domain", counts.out_of_domain_count},
          {"nan", counts.nan_count},
          {"infinite", counts.infinite_count},
          {"negative", counts.negative_count},
          {"first_bad", position_json(counts.first_bad)},
          {"clipped_values", counts.clipped_count}};
}

Json job_json(const Outcome& outcome, const JobReport& report) {
  const ChosenConverter& chosen = outcome.chosen;
  const MapStatistics& counts = report.statistics;
  Json json, values;
  std::vector<Parameter> named = chosen.converter().targets();
  for (const Parameter parameter : named) json[plain_name(parameter)] = file_json(report, parameter);
  json["mask"] = file_json(report, [](const JobReport::Result& result) { return result.mask; });
  json["copies"] = paths_json(report.copies);
  json["left_behind"] = paths_json(report.left_behind);
  if (outcome.dry_run) {
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
    if (std::find(named.begin(), named.end(), parameter) == named.end()) named.push_back(parameter);
  const auto of = [&](const auto& all, Parameter parameter) {
    const auto found = all.find(parameter);
    return found == all.end() ? Json() : values_json(found->second, outcome.histograms);
  };
  for (const Parameter parameter : named)
    if (parameter != Parameter::kDoubts)
      values[plain_name(parameter)] = {{"source", of(counts.sources, parameter)},
                                       {"target", of(counts.targets, parameter)}};
  json["values"] = values;
  if (chosen.workflow.is_material()) {
    json["masked"] = counts.masked_count;
    json["above_one"] = counts.above_one_count;
    json["metallic_confidence"] = metallic_json(counts.metallic);
    json["estimated_dielectric_f0"] = f0_json(report.estimated_f0);
  }
  json["warnings"] = report.warnings;
  json["seconds"] = report.seconds;
  json["bytes_read"] = report.bytes_read;
  json["bytes_written"] = report.bytes_written;
  json["texels_per_second"] =
      report.seconds > 0.0 ? Json(static_cast<double>(counts.texel_count) / report.seconds) : Json();
  return json;
}

std::string_view state_text(const JobReport& report, bool dry_run) {
  if (report.failure) return "failed";
  if (report.was_done) return "done before";
  return dry_run ? "planned" : "converted";
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

// One set of a tree.
Json set_json(const Outcome& outcome, const JobReport& report) {
  Json json = {{"name", report.name},
               {"state", state_text(report, outcome.dry_run)},
               {"failure", report.failure ? Json(*report.failure) : Json()},
               {"tiles", report.tiles},
               {"results", Json::list()},
               {"inputs", paths_json(report.inputs)}};
  for (const JobReport::Result& result : report.results) json["results"].push_back(result.path.string());
  json.update(job_json(outcome, report));
  return json;
}

// What the run took, and what it assumed.
Json run_json(const Outcome& outcome) {
  return {{"colors", colors_json(outcome.colors())},
          {"instructions", std::string(instruction_set_name(outcome.chosen.info().instructions))},
          {"seconds", outcome.seconds},
          {"processor_seconds", outcome.used.processor_seconds},
          {"peak_memory_bytes", outcome.used.peak_memory_bytes}};
}

}  // namespace

void print_json(const Outcome& outcome) {
  Json result = converter_json(outcome.chosen);
  result.update(job_json(outcome, outcome.reports.front()));
  result.update(run_json(outcome));
  print(result);
}

void tell_start(const Outcome& outcome, const TakeLine& take) {
  take({{"conversion", converter_json(outcome.chosen)}});
  for (const SkippedSet& entry : outcome.list.left_out)
    take({{"left_out", {{"message", entry.message}, {"is_failure", entry.is_failure}}}});
}

void tell_set(const Outcome& outcome, const JobReport& report, const TakeLine& take) {
  take({{"set", set_json(outcome, report)}});
}

void tell_end(const Outcome& outcome, const TakeLine& take) {
  std::map<std::string_view, std::size_t> states = {
      {"converted", 0}, {"done before", 0}, {"failed", 0}, {"planned", 0}};
  for (const JobReport& report : outcome.reports) ++states[state_text(report, outcome.dry_run)];
  Json summary = {{"sets", outcome.reports.size()},
                  {"converted", states["converted"]},
                  {"done_before", states["done before"]},
                  {"planned", states["planned"]},
                  {"failed", outcome.failed_count()},
                  {"left_out", outcome.list.left_out.size()},
                  {"unrecognised_images", paths_json(outcome.list.unrecognised)}};
  summary.update(run_json(outcome));
  take({{"summary", summary}});
}

void print_values(const ChosenConverter& chosen, const ConvertedValues& values, bool json) {
  if (json) {
    Json result = converter_json(chosen);
    for (const ConvertedValues::Value& value : values.values)
      result["values"][value.name] =
          value.channels.size() == 1 && value.is_scalar ? Json(value.channels.front()) : Json(value.channels);
    result["in_domain"] = values.in_domain;
    print(result);
    return;
  }
  // Six digits: the precision of a float.
  std::cout << std::setprecision(6);
  for (const ConvertedValues::Value& value : values.values) {
    std::cout << value.name;
    for (const float channel : value.channels) std::cout << " " << channel;
    std::cout << "\n";
  }
}

}  // namespace remap
