#include "texremap/asset_report.hpp"

#include <utility>

#include "command_line/run_app.hpp"
#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/commands.hpp"
#include "texremap/converter_text.hpp"

namespace remap {
namespace {

constexpr double kShownError = 5e-4;

std::string error_text(const AssetMaterial& material) {
  const double error = kPictureOfResidual * material.residual;
  return error < kShownError ? "" : " (pictures differ by " + number_text(rounded(100.0 * error, 2)) + " %)";
}

void print_material(const AssetMaterial& material, const std::string& place, bool dry_run,
                    bool failures_only) {
  if (!failures_only)
    for (const std::string& warning : material.warnings)
      print_message(kProgram, "warning: " + place + material.title() + ": " + warning);
  if (material.state == MaterialState::kFailed)
    print_message(kProgram, place + material.title() + ": failed: " + material.failure);
  if (material.state == MaterialState::kConverted && dry_run && !failures_only)
    print_message(kProgram,
                  place + material.title() + ": would become " + material.becomes + error_text(material));
}

std::string outcome_text(const AssetReport& report, bool dry_run) {
  const std::size_t converted = report.count(MaterialState::kConverted),
                    untouched = report.count(MaterialState::kUntouched);
  const std::string verb = dry_run ? "would be " : "";
  std::string text;
  if (converted == 0 && report.failed_count() == 0)
    text = "nothing to convert, " + verb + "copied";
  else
    text = counted(converted, "material") + " " + verb + "converted";
  if (report.failed_count() > 0) text += ", " + std::to_string(report.failed_count()) + " failed";
  if (untouched > 0)
    text += ", " + std::to_string(untouched) + " left as " + (untouched == 1 ? "it is" : "they are");
  if (!report.is_written) return text + "; nothing " + verb + "written";
  if (!dry_run) text += " in " + fixed(report.seconds, 2) + " s";
  text += ": " + shown(report.output);
  if (!report.images.empty()) text += ", plus " + counted(report.images.size(), "new file");
  if (!report.copies.empty())
    text += (report.images.empty() ? ", plus " : " and ") + counted(report.copies.size(), "copied file");
  return text;
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

}  // namespace

void print_asset(const AssetReport& report, bool dry_run, bool failures_only) {
  const std::string place = shown(report.input) + ": ";
  if (!failures_only)
    for (const std::string& warning : report.warnings) print_message(kProgram, "warning: " + place + warning);
  if (!report.failure.empty()) return print_message(kProgram, "failed: " + report.failure);
  if (report.was_done) return;
  for (const AssetMaterial& material : report.materials)
    print_material(material, place, dry_run, failures_only);
  if (!failures_only) print_message(kProgram, place + outcome_text(report, dry_run));
}

Json asset_json(const AssetReport& report, bool dry_run) {
  Json json = {{"asset", report.input.string()},
               {"output", report.is_written ? Json(report.output.string()) : Json()},
               {"dry_run", dry_run},
               {"was_done", report.was_done}};
  for (const auto& state : kMaterialStates) json[std::string(state.name)] = report.count(state.value);
  json["materials"] = Json::list();
  for (const AssetMaterial& material : report.materials) json["materials"].push_back(material_json(material));
  for (const auto& [name, paths] :
       {std::pair("images", &report.images), std::pair("copies", &report.copies)}) {
    json[name] = Json::list();
    for (const std::filesystem::path& path : *paths) json[name].push_back(path.string());
  }
  json["warnings"] = report.warnings;
  json["failure"] = report.failure.empty() ? Json() : Json(report.failure);
  json["seconds"] = rounded(report.seconds, 3);
  return json;
}

AssetSummary summary_of(const std::vector<AssetReport>& reports) {
  AssetSummary summary;
  summary.asset_count = reports.size();
  for (const AssetReport& report : reports) {
    summary.written += report.is_written && report.failure.empty() ? 1 : 0;
    summary.done_before += report.was_done ? 1 : 0;
    summary.failed += report.has_failed() ? 1 : 0;
    summary.materials += report.count(MaterialState::kConverted);
  }
  return summary;
}

std::string summary_text(const AssetSummary& summary, bool dry_run) {
  const std::string would = dry_run ? "would be " : "";
  std::string text = std::to_string(summary.written) + " of " + counted(summary.asset_count, "asset") + " " +
                     would + "written, " + counted(summary.materials, "material") + " " + would + "converted";
  if (summary.done_before > 0) text += ", " + std::to_string(summary.done_before) + " done before";
  if (summary.failed > 0) text += ", " + std::to_string(summary.failed) + " failed";
  return text + " in " + fixed(summary.seconds, 2) + " s";
}

Json summary_json(const AssetSummary& summary) {
  Json problems = Json::list();
  for (const std::string& problem : summary.problems) problems.push_back(problem);
  return {{"summary",
           {{"assets", summary.asset_count},
            {"written", summary.written},
            {"done_before", summary.done_before},
            {"failed", summary.failed},
            {"materials_converted", summary.materials},
            {"problems", problems},
            {"seconds", rounded(summary.seconds, 3)},
            {"processor_seconds", summary.used.processor_seconds},
            {"peak_memory_bytes", summary.used.peak_memory_bytes}}}};
}

}  // namespace remap
