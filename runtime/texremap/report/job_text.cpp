#include <algorithm>
#include <iostream>

#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/options/convert_options.hpp"
#include "texremap/plan/converter_text.hpp"
#include "texremap/report/reporter.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {
namespace {

// Returns both ends of a workflow conversion, and the steps between them.
std::string material_text(const BuiltConversion& chosen) {
  const ConversionChoice& workflow = chosen.choice;
  if (workflow.translation) return chosen.info().source.model + " to " + chosen.info().target.model;
  const auto end_text = [](const WorkflowEnd& end) {
    return model_of(end) + " (" + std::string(kind_name(end)) + ": " + conventions_text(end) + ")";
  };
  std::string text = end_text(*workflow.source) + " to " + end_text(*workflow.target);
  if (workflow.finds_metallic()) text += " by projection";
  if (workflow.changes_nothing)
    text += ", unchanged";
  else if (chosen.brdf == nullptr)
    for (const std::string& step : chosen.info().steps) text += " by " + step;  // a warp
  else
    text += ", " + models_text(chosen.path);
  return text;
}

// Returns the domain that some texels are outside of.
std::string outside_text(const BuiltConversion& chosen) {
  const std::string domain = domain_text(chosen.domain());
  return chosen.path.steps.size() <= 1 ? "the measured range (" + domain + ")"
                                       : "the measured range of a step (path: " + domain + ")";
}

std::string first_text(const MapStatistics& counts) {
  if (!counts.first_bad) return "";
  return "; first bad texel: (" + std::to_string(counts.first_bad->x) + ", " +
         std::to_string(counts.first_bad->y) + ")";
}

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

std::string left_behind_text(const JobReport& report) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : report.left_behind) names.push_back(file.filename().string());
  return "skipped: " + joined(names, ", ");
}

// Prints how much of a material metal-rough cannot express, if a picture would show it. With `verbose`, also
// prints how reliable metallic is.
void print_confidence(const std::string& context, const SetPlan& sets, const JobReport& report,
                      bool verbose) {
  const MapStatistics& counts = report.statistics;
  const MetallicStatistics& metallic = counts.metallic;
  const bool is_estimate = sets.dielectric_f0 == F0Choice(F0Source::kMaps);
  if (const auto& f0 = report.estimated_f0; f0 && (verbose || is_estimate || report.name.empty())) {
    const double of_model = std::get<MetallicWorkflow>(*sets.chosen.choice.target).dielectric_f0;
    say(context + "dielectric F0 estimated from the maps: " + number_text(used_f0(*f0)) +
        (f0->is_certain ? "" : " (uncertain: too few texels)") + "; " +
        number_text(is_estimate && f0->is_certain ? used_f0(*f0) : of_model) + " is used");
  }
  if (metallic.texel_count == 0) return;
  const double difference = kPictureOfResidual * metallic.rms_residual();
  const auto percent = [](double share, int decimals) { return fixed(100.0 * share, decimals) + " %"; };
  if (difference >= kVisible)
    say(context + "metal-rough cannot express these maps exactly; the visible difference is about " +
        percent(difference, 0) + " (--diagnose DIR shows where)");
  if (!verbose) return;
  const auto share = [&](std::size_t count) {
    return percent(static_cast<double>(count) / static_cast<double>(metallic.texel_count), 2);
  };
  say(context + "residual of metal-rough: " + fixed(metallic.rms_residual(), 4) + " rms, " +
      fixed(static_cast<double>(metallic.largest_residual), 3) + " at most");
  say(context + "metallic is undetermined, without visible effect, in " + share(metallic.undetermined.count) +
      " of the texels (too dark in " + share(metallic.dark.count) + "), has two possible values in " +
      share(metallic.ambiguous.count) + ", is clamped in " + share(metallic.clamped.count));
}

std::string value_text(const SurfaceValue& value) {
  std::string text = value.name + " ";
  const bool is_grey = std::ranges::all_of(value.values, [&](float c) { return c == value.values.front(); });
  for (std::size_t c = 0; c < (is_grey ? 1 : value.values.size()); ++c)
    text += (c == 0 ? "" : ",") + number_text(rounded(static_cast<double>(value.values[c]), 4));
  return text;
}

// Prints the inputs that the user must set in the shader, because no map holds them. Also prints the inputs
// that have no effect in the target.
void print_effect(const ConvertPlan& plan, const std::string& context, const TranslationEffect& effect) {
  const std::string& target = plan.sets()->chosen.info().target.model;
  std::vector<std::string> values;
  for (const SurfaceValue& value : effect.values) values.push_back(value_text(value));
  if (!values.empty()) say(context + "set these inputs of " + target + ": " + joined(values, ", "));
  if (!effect.lost.empty()) say(context + "no effect in " + target + ": " + joined(effect.lost, ", "));
}

void print_set(const ConvertPlan& plan, const std::string& context, const JobReport& report) {
  const BuiltConversion& chosen = plan.sets()->chosen;
  if (report.effect) print_effect(plan, context, *report.effect);
  if (plan.dry_run) {
    say(context + "would write " + files_text(report) + " from " + counted(report.inputs.size(), "file") +
        " (first: " + report.inputs.front().string() + ")");
    if (!plan.json) std::cout << plan_table(report.plan);
    return;
  }
  const MapStatistics& counts = report.statistics;
  const auto line = [&](std::size_t count, const std::string& what, const char* noun = "texel") {
    if (count > 0) say(context + counted(count, noun) + what);
  };
  const std::string by = plan.list.has_several ? "" : " by " + converter_text(chosen);
  if (counts.texel_count == 0) say(context + "copied: " + files_text(report));
  line(counts.texel_count, " in " + fixed(report.seconds, 2) + " s" + by + ": " + files_text(report));
  if (plan.verbose && !report.left_behind.empty()) say(context + left_behind_text(report));
  print_confidence(context, *plan.sets(), report, plan.verbose);
  const auto is_told = [&](std::size_t count) {
    return plan.verbose || !plan.list.has_several ||
           static_cast<double>(count) >= kVisible * static_cast<double>(counts.texel_count);
  };
  const auto visible_line = [&](std::size_t count, const std::string& what, const char* noun = "texel") {
    if (is_told(count)) line(count, what, noun);
  };
  if (plan.verbose) line(counts.masked_count, " with opacity 0 converted, but not counted in these lines");
  visible_line(
      counts.above_one_count,
      " clamped to 1, instead of reflecting more light than arrives (put emission into a separate map)");
  visible_line(counts.out_of_domain_count,
               " outside " + outside_text(chosen) + ": roughness is clamped, specular is extrapolated");
  line(counts.nan_count, " with NaN" + first_text(counts));
  line(counts.infinite_count, " with infinite values" + first_text(counts));
  line(counts.negative_count, " with negative values" + first_text(counts));
  visible_line(counts.clipped_count, " clipped to 0 or 1, the limits of integer pixels", "value");
}

// A picture does not show an error below this value.
constexpr double kShownError = 5e-4;

std::string error_text(const AssetMaterial& material) {
  const double error = kPictureOfResidual * material.residual;
  return error < kShownError ? "" : " (pictures differ by " + number_text(rounded(100.0 * error, 2)) + " %)";
}

void print_material(const AssetMaterial& material, const std::string& context, bool dry_run, bool quiet) {
  if (!quiet)
    for (const std::string& warning : material.warnings)
      say("warning: " + context + material.title() + ": " + warning);
  if (material.state == MaterialState::kFailed)
    say(context + material.title() + ": failed: " + material.failure);
  if (material.state == MaterialState::kConverted && dry_run && !quiet)
    say(context + material.title() + ": would become " + material.becomes + error_text(material));
}

std::string outcome_text(const JobReport& report, bool dry_run) {
  const std::size_t converted = report.count(MaterialState::kConverted),
                    failed = report.count(MaterialState::kFailed),
                    untouched = report.count(MaterialState::kUntouched);
  const std::string verb = dry_run ? "would be " : "";
  std::string text = converted == 0 && failed == 0
                         ? "nothing to convert" + std::string(report.results.empty() ? ""
                                                              : dry_run ? ", the file would be copied"
                                                                        : ", the file was copied")
                         : counted(converted, "material") + " " + verb + "converted";
  if (failed > 0) text += ", " + std::to_string(failed) + " failed";
  if (untouched > 0) text += ", " + std::to_string(untouched) + " unchanged";
  if (report.results.empty()) return text + "; nothing " + verb + "written";
  if (!dry_run) text += " in " + fixed(report.seconds, 2) + " s";
  text += ": " + display_path(report.results.front().path);
  const std::size_t images = report.results.size() - 1;
  if (images > 0) text += ", plus " + counted(images, "new file");
  if (!report.copies.empty())
    text += (images == 0 ? ", plus " : " and ") + counted(report.copies.size(), "copied file");
  return text;
}

}  // namespace

std::string converter_text(const BuiltConversion& chosen) {
  if (chosen.choice.is_material()) return material_text(chosen);
  if (chosen.path.steps.size() == 1) return chosen.info().id;
  return models_text(chosen.path);
}

bool WarningKinds::is_new(const std::string& warning) {
  const std::size_t colon = warning.find(": ");
  const std::string kind = colon == std::string::npos ? warning : warning.substr(colon + 2);
  if (counts_.contains(kind) || counts_.size() < kShownKinds) return ++counts_[kind] <= kShownOfKind;
  ++unshown_;
  return false;
}

std::size_t WarningKinds::repeated() const {
  std::size_t more = unshown_;
  for (const auto& [kind, count] : counts_) more += count - std::min(count, kShownOfKind);
  return more;
}

void print_job(const ConvertPlan& plan, const JobReport& report, WarningKinds& warnings) {
  const bool is_asset = plan.sets() == nullptr;
  std::string place = report.name.empty() ? "" : display_path(report.name) + ": ";
  if (!report.tiles.empty()) place += counted(report.tiles.size(), plan.list.tile_noun) + ": ";
  if (!plan.quiet)
    for (const std::string& warning : report.warnings)
      if (const std::string text = (is_asset ? place : "") + warning;
          plan.verbose || !plan.list.has_several || warnings.is_new(text))
        say("warning: " + text);
  if (report.failure) return say((is_asset ? "" : place) + "failed: " + *report.failure);
  if (report.was_done) return;
  for (const AssetMaterial& material : report.materials)
    print_material(material, place, plan.dry_run, plan.quiet);
  if (plan.quiet) return;
  if (is_asset)
    say(place + outcome_text(report, plan.dry_run));
  else
    print_set(plan, place, report);
}

void print_colors(const ColorNotes& colors, bool has_several) {
  std::vector<std::pair<std::string, std::size_t>> phrases;  // equal reasons share one phrase
  for (const bool is_written : {false, true})
    for (const auto& [note, count] : colors) {
      if (note.is_written != is_written) continue;
      std::string phrase = std::string(parameter_name(note.color)) +
                           (is_written ? " written as " : " read as ") +
                           std::string(name_of(kTransfers, note.transfer));
      if (note.reason == TransferReason::kUser)
        phrase += is_written ? " (--output-color-space)" : " (--color-space)";
      if (note.reason == TransferReason::kFile && note.transfer != Transfer::kSrgb)
        phrase += is_written ? " (as in the source map)" : " (as the file's tag states)";
      const auto known =
          std::ranges::find_if(phrases, [&](const auto& entry) { return entry.first == phrase; });
      if (known == phrases.end())
        phrases.emplace_back(phrase, count);
      else
        known->second += count;
    }
  std::string text;
  for (const auto& [phrase, count] : phrases)
    text += (text.empty() ? "" : ", ") + phrase + (has_several ? " in " + counted(count, "map") : "");
  if (text.empty()) return;
  say("color: " + text + "; --color-space and --output-color-space change this");
}

}  // namespace remap
