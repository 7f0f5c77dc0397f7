#include "texremap/convert_report.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "command_line/run_app.hpp"
#include "texremap/converter_text.hpp"
#include "text/number_text.hpp"
#include "text/report_text.hpp"

namespace remap {
namespace {

// `diffuse plain, dielectric F0 0.04`.
std::string conventions_text(const WorkflowEnd& end) {
  std::string text = "diffuse " + std::string(diffuse_convention_name(diffuse_of(end)));
  if (const auto* metallic = std::get_if<MetallicWorkflow>(&end))
    text += ", dielectric F0 " + number_text(metallic->dielectric_f0);
  return text;
}

// Both ends of a workflow conversion, and the steps between them.
std::string material_text(const ChosenConverter& chosen) {
  const WorkflowChoice& workflow = chosen.workflow;
  const auto end_text = [](const WorkflowEnd& end) {
    return model_of(end) + " (" + std::string(kind_name(end)) + ": " + conventions_text(end) + ")";
  };
  std::string text = end_text(*workflow.source) + " to " + end_text(*workflow.target);
  if (workflow.is_to_metallic()) text += " by " + std::string(formula_name(workflow.formula));
  if (chosen.brdf == nullptr)
    for (const std::string& step : chosen.info().steps) text += " by " + step;  // a warp
  else
    text += ", " + models_text(chosen.path) + " (expected error " +
            expected_text(chosen.path.expected_error) + ")";
  return text;
}

// The id of a single converter, or the models of a path.
std::string converter_text(const ChosenConverter& chosen) {
  if (chosen.workflow.is_material()) return material_text(chosen);
  if (chosen.path.steps.size() == 1) return chosen.info().id;
  return models_text(chosen.path) + " (expected error " + expected_text(chosen.path.expected_error) + ")";
}

// The domain that texels were outside of.
std::string outside_text(const ChosenConverter& chosen) {
  const std::string domain = domain_text(chosen.domain());
  return chosen.path.steps.size() <= 1 ? "the domain (" + domain + ")"
                                       : "the domain of a step (path: " + domain + ")";
}

Json position_json(const std::optional<TexelPosition>& texel) {
  return texel ? Json{texel->x, texel->y} : Json();
}

std::string first_text(const MapStatistics& counts) {
  if (!counts.first_bad) return "";
  return "; first bad texel: (" + std::to_string(counts.first_bad->x) + ", " +
         std::to_string(counts.first_bad->y) + ")";
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
  Json names = Json::array();
  for (const std::filesystem::path& path : paths) names.push_back(path.string());
  return names;
}

Json values_json(const ParameterStatistics& statistics) {
  if (statistics.finite_count == 0) return {};
  return {{"min", statistics.min}, {"max", statistics.max}, {"histogram", statistics.histogram}};
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
  json.update(closeness_json(chosen.path, chosen.closeness));
  if (!chosen.workflow.is_material()) return json;
  json["workflow"] = {
      {"source", end_json(*chosen.workflow.source)},
      {"target", end_json(*chosen.workflow.target)},
      {"formula",
       chosen.workflow.is_to_metallic() ? Json(std::string(formula_name(chosen.workflow.formula))) : Json()},
      {"assumptions", chosen.workflow.assumptions}};
  return json;
}

// The reliability of the metallic that was found.
Json metallic_json(const MetallicStatistics& metallic) {
  if (metallic.texel_count == 0) return {};
  return {{"texels", metallic.texel_count},
          {"rms_residual", metallic.rms_residual()},
          {"largest_residual", metallic.largest_residual},
          {"guesses", metallic.guess.count},
          {"guesses_in_the_dark", metallic.dark.count},
          {"two_answers", metallic.two_answers.count},
          {"clamped", metallic.clamped.count},
          {"first",
           {{"guess", position_json(metallic.guess.first)},
            {"guess_in_the_dark", position_json(metallic.dark.first)},
            {"two_answers", position_json(metallic.two_answers.first)},
            {"clamped", position_json(metallic.clamped.first)}}}};
}

Json f0_json(const std::optional<DielectricF0>& f0) {
  if (!f0) return {};
  return {{"value", f0->f0}, {"residual", f0->residual}, {"is_certain", f0->is_certain}};
}

void print(const Json& json) {
  // File names need not be UTF-8.
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string seconds_text(double seconds) { return remapc::fixed(seconds, 2) + " s"; }

std::string files_text(const JobReport& report) {
  constexpr std::size_t kShown = 3;
  const std::vector<JobReport::Result>& results = report.results;
  std::string text;
  for (std::size_t i = 0; i < std::min(results.size(), kShown); ++i)
    text += (i == 0 ? "" : ", ") + results[i].path.string();
  if (results.size() > kShown) text += " and " + std::to_string(results.size() - kShown) + " more";
  if (!report.copies.empty()) text += ", plus " + counted(report.copies.size(), "copied file");
  return text;
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

Json job_json(const ChosenConverter& chosen, const JobReport& report) {
  const MapStatistics& counts = report.statistics;
  Json json, values;
  std::vector<Parameter> named = chosen.converter().targets();
  for (const Parameter parameter : named)
    if (parameter != Parameter::kDoubts) json[plain_name(parameter)] = file_json(report, parameter);
  json["mask"] = file_json(report, [](const JobReport::Result& result) { return result.mask; });
  json["copies"] = paths_json(report.copies);
  json["specular_color_space"] = name_of(kTransfers, report.specular_transfer);
  json.update(counts_json(counts));
  for (const Parameter parameter : chosen.converter().sources())
    if (std::find(named.begin(), named.end(), parameter) == named.end()) named.push_back(parameter);
  const auto of = [](const auto& all, Parameter parameter) {
    const auto found = all.find(parameter);
    return found == all.end() ? Json() : values_json(found->second);
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
    json["warnings"] = report.warnings;
  }
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

// One set of a tree.
Json set_json(const ChosenConverter& chosen, const JobReport& report, bool dry_run) {
  Json json = {{"name", report.name},
               {"state", state_text(report, dry_run)},
               {"failure", report.failure ? Json(*report.failure) : Json()},
               {"tiles", report.tiles},
               {"results", Json::array()},
               {"inputs", paths_json(report.inputs)}};
  for (const JobReport::Result& result : report.results) json["results"].push_back(result.path.string());
  json.update(job_json(chosen, report));
  return json;
}

Json tree_json(const Outcome& outcome) {
  Json sets = Json::array(), left_out = Json::array();
  for (const JobReport& report : outcome.reports)
    sets.push_back(set_json(outcome.chosen, report, outcome.dry_run));
  for (const LeftOut& entry : outcome.list.left_out)
    left_out.push_back({{"message", entry.message}, {"is_failure", entry.is_failure}});
  return {{"sets", sets}, {"left_out", left_out}, {"unrecognised_images", outcome.list.unrecognised_count}};
}

}  // namespace

WorkflowStages stages_of(const ChosenConverter& chosen) {
  WorkflowStages stages{*chosen.workflow.source, *chosen.workflow.target};
  stages.brdf = chosen.brdf;
  stages.width = width_of(stages.target);
  stages.formula = chosen.workflow.formula;
  return stages;
}

std::string converter_ids(const ChosenConverter& chosen) {
  std::string ids;
  for (const Converter* step : chosen.path.steps) ids += (ids.empty() ? "" : " ") + step->info().id;
  if (!chosen.workflow.is_material()) return ids;
  return ids + (ids.empty() ? "" : " ") + chosen.info().id + " (" +
         conventions_text(*chosen.workflow.source) + "; " + conventions_text(*chosen.workflow.target) +
         (chosen.workflow.is_to_metallic() ? "; " + std::string(formula_name(chosen.workflow.formula)) : "") +
         ")";
}

JobReport& JobReport::operator+=(const JobReport& other) {
  const auto append = [](auto& all, const auto& more) {
    for (const auto& entry : more)
      if (std::find(all.begin(), all.end(), entry) == all.end()) all.push_back(entry);
  };
  append(tiles, other.tiles);
  append(inputs, other.inputs);
  append(copies, other.copies);
  append(warnings, other.warnings);
  results.insert(results.end(), other.results.begin(), other.results.end());
  was_done = was_done && other.was_done;
  if (other.failure) failure = failure ? *failure + "; " + *other.failure : other.failure;
  if (!estimated_f0) estimated_f0 = other.estimated_f0;
  statistics += other.statistics;
  seconds += other.seconds;
  bytes_read += other.bytes_read;
  bytes_written += other.bytes_written;
  return *this;
}

std::size_t Outcome::failed_count() const {
  std::size_t count = 0;
  for (const JobReport& report : reports) count += report.failure.has_value();
  for (const LeftOut& entry : list.left_out) count += entry.is_failure;
  return count;
}

namespace {

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

double f0_of(const ChosenConverter& chosen, const DielectricF0& estimated) {
  if (chosen.workflow.estimates_f0 && estimated.is_certain) return rounded(estimated.f0);
  return std::get<MetallicWorkflow>(*chosen.workflow.target).dielectric_f0;
}

// Prints the reliability of the metallic that was found.
void print_confidence(const std::string& program, const std::string& place, const ChosenConverter& chosen,
                      const JobReport& report) {
  const MapStatistics& counts = report.statistics;
  const MetallicStatistics& metallic = counts.metallic;
  if (const auto& f0 = report.estimated_f0)
    print_message(program, place + "dielectric F0 estimated from the maps: " + number_text(rounded(f0->f0)) +
                               (f0->is_certain ? "" : " (uncertain: too few texels)") + "; " +
                               number_text(f0_of(chosen, *f0)) + " is used");
  if (counts.masked_count > 0)
    print_message(program, place + std::to_string(counts.masked_count) +
                               " transparent texels are converted, but not counted below");
  if (counts.above_one_count > 0)
    print_message(program,
                  place + "warning: " + std::to_string(counts.above_one_count) +
                      " texels reflect more than 1; clamped to 1 (put emission into a map of its own)");
  if (metallic.texel_count == 0) return;
  const auto share = [&](std::size_t count) {
    const double part = static_cast<double>(count) / static_cast<double>(metallic.texel_count);
    return remapc::fixed(100.0 * part, 2) + " %";
  };
  const std::string residual = remapc::fixed(metallic.rms_residual(), 4) + " rms, " +
                               remapc::fixed(static_cast<double>(metallic.largest_residual), 3) + " at most";
  print_message(program, place + "not representable in metal-rough (residual): " + residual +
                             "; pictures differ by about 0.42 of it");
  print_message(program, place + "metallic undetermined, no visible effect: " + share(metallic.guess.count) +
                             " (too dark: " + share(metallic.dark.count) +
                             "); ambiguous: " + share(metallic.two_answers.count) +
                             "; clamped: " + share(metallic.clamped.count));
}

}  // namespace

void print_job(const std::string& program, const Outcome& outcome, const JobReport& report) {
  std::string place = report.name.empty() ? "" : report.name + ": ";
  if (!report.tiles.empty()) place += counted(report.tiles.size(), outcome.list.tile_noun) + ": ";
  for (const std::string& warning : report.warnings) print_message(program, "warning: " + warning);
  if (report.failure) {
    print_message(program, place + "failed: " + *report.failure);
    return;
  }
  if (report.was_done) return;
  if (outcome.dry_run) {
    print_message(program, place + "would write " + files_text(report) + " from " +
                               counted(report.inputs.size(), "file") +
                               " (first: " + report.inputs.front().string() + ")");
    return;
  }
  const MapStatistics& counts = report.statistics;
  const auto line = [&](std::size_t count, const std::string& what) {
    if (count > 0) print_message(program, place + std::to_string(count) + what);
  };
  const std::string by = outcome.list.is_tree ? "" : " by " + converter_text(outcome.chosen);
  line(counts.texel_count, " texels in " + seconds_text(report.seconds) + by + ": " + files_text(report));
  print_confidence(program, place, outcome.chosen, report);
  line(counts.out_of_domain_count, " texels outside " + outside_text(outcome.chosen) +
                                       ": roughness clamped, specular extrapolated in proportion");
  line(counts.nan_count, " texels with NaN" + first_text(counts));
  line(counts.infinite_count, " texels with infinite values" + first_text(counts));
  line(counts.negative_count, " texels with negative values" + first_text(counts));
  line(counts.clipped_count, " values clipped to [0, 1] by an integer pixel type");
}

void print_summary(const std::string& program, const Outcome& outcome) {
  if (!outcome.list.is_tree) return;
  std::size_t texels = 0, done = 0, done_before = 0;
  for (const JobReport& report : outcome.reports) {
    done += !report.failure && !report.was_done;
    done_before += report.was_done;
    texels += report.statistics.texel_count;
  }
  for (const LeftOut& entry : outcome.list.left_out)
    print_message(program, (entry.is_failure ? "failed: " : "skipped: ") + entry.message);
  std::string text = counted(done, "set") + (outcome.dry_run ? " would be converted by " : " converted by ") +
                     converter_text(outcome.chosen) + ", " + std::to_string(outcome.failed_count()) +
                     " failed";
  if (done_before > 0) text += ", " + std::to_string(done_before) + " done before";
  if (!outcome.dry_run)
    text += "; " + std::to_string(texels) + " texels in " + seconds_text(outcome.seconds) + ", " +
            seconds_text(outcome.used.processor_seconds) + " of processor time";
  if (outcome.list.unrecognised_count > 0)
    text += "; unrecognised images skipped: " + std::to_string(outcome.list.unrecognised_count);
  print_message(program, text);
}

void print_json(const Outcome& outcome) {
  Json result = converter_json(outcome.chosen);
  result.update(outcome.list.is_tree ? tree_json(outcome)
                                     : job_json(outcome.chosen, outcome.reports.front()));
  result["instructions"] = std::string(instruction_set_name(outcome.chosen.info().instructions));
  result["seconds"] = outcome.seconds;
  result["processor_seconds"] = outcome.used.processor_seconds;
  result["peak_memory_bytes"] = outcome.used.peak_memory_bytes;
  print(result);
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
