#include "texremap/convert_report.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "command_line/run_app.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/converter_text.hpp"

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
  if (workflow.finds_metallic()) text += " by projection";
  if (workflow.changes_nothing)
    text += ", unchanged";
  else if (chosen.brdf == nullptr)
    for (const std::string& step : chosen.info().steps) text += " by " + step;  // a warp
  else
    text += ", " + models_text(chosen.path);
  return text;
}

// The id of a single converter, or the models of a path.
std::string converter_text(const ChosenConverter& chosen) {
  if (chosen.workflow.is_material()) return material_text(chosen);
  if (chosen.path.steps.size() == 1) return chosen.info().id;
  return models_text(chosen.path);
}

// The domain that texels were outside of.
std::string outside_text(const ChosenConverter& chosen) {
  const std::string domain = domain_text(chosen.domain());
  return chosen.path.steps.size() <= 1 ? "the domain (" + domain + ")"
                                       : "the domain of a step (path: " + domain + ")";
}

std::string first_text(const MapStatistics& counts) {
  if (!counts.first_bad) return "";
  return "; first bad texel: (" + std::to_string(counts.first_bad->x) + ", " +
         std::to_string(counts.first_bad->y) + ")";
}

std::string seconds_text(double seconds) { return fixed(seconds, 2) + " s"; }

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
  return "left out: " + joined(names, ", ");
}

}  // namespace

std::string converter_ids(const ChosenConverter& chosen) {
  std::string ids;
  for (const Converter* step : chosen.path.steps) ids += (ids.empty() ? "" : " ") + step->info().id;
  if (!chosen.workflow.is_material()) return ids;
  return ids + (ids.empty() ? "" : " ") + chosen.info().id + " (" +
         conventions_text(*chosen.workflow.source) + "; " + conventions_text(*chosen.workflow.target) +
         (chosen.workflow.finds_metallic() ? "; projection)" : ")");
}

JobReport& JobReport::operator+=(const JobReport& other) {
  const auto append = [](auto& all, const auto& more) {
    for (const auto& entry : more)
      if (std::find(all.begin(), all.end(), entry) == all.end()) all.push_back(entry);
  };
  append(tiles, other.tiles);
  append(inputs, other.inputs);
  append(copies, other.copies);
  append(left_behind, other.left_behind);
  append(warnings, other.warnings);
  results.insert(results.end(), other.results.begin(), other.results.end());
  was_done = was_done && other.was_done;
  has_8_bits = has_8_bits || other.has_8_bits;
  has_compression_level = has_compression_level || other.has_compression_level;
  if (other.failure) failure = failure ? *failure + "; " + *other.failure : other.failure;
  if (!passes_later(failure_code)) failure_code = other.failure_code;
  for (const auto& [note, count] : other.colors) colors[note] += count;
  if (plan.empty()) plan = other.plan;
  if (!estimated_f0) estimated_f0 = other.estimated_f0;
  statistics += other.statistics;
  seconds += other.seconds;
  bytes_read += other.bytes_read;
  bytes_written += other.bytes_written;
  return *this;
}

ColorNotes Outcome::colors() const {
  ColorNotes all;
  for (const JobReport& report : reports)
    for (const auto& [note, count] : report.colors) all[note] += count;
  return all;
}

std::size_t Outcome::failed_count() const {
  std::size_t count = 0;
  for (const JobReport& report : reports) count += report.failure.has_value();
  for (const SkippedSet& entry : list.left_out) count += entry.is_failure;
  return count;
}

int Outcome::passing_failure() const {
  for (const JobReport& report : reports)
    if (report.failure && passes_later(report.failure_code)) return report.failure_code;
  return 0;
}

namespace {

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

double f0_of(const ChosenConverter& chosen, const DielectricF0& estimated) {
  if (chosen.workflow.estimates_f0 && estimated.is_certain) return rounded(estimated.f0);
  return std::get<MetallicWorkflow>(*chosen.workflow.target).dielectric_f0;
}

// Prints what metal-rough cannot express where it is visible, with `verbose` also how reliable metallic is.
void print_confidence(const std::string& program, const std::string& place, const ChosenConverter& chosen,
                      const JobReport& report, bool verbose) {
  const MapStatistics& counts = report.statistics;
  const MetallicStatistics& metallic = counts.metallic;
  if (const auto& f0 = report.estimated_f0;
      f0 && (verbose || chosen.workflow.estimates_f0 || report.name.empty()))
    print_message(program, place + "dielectric F0 estimated from the maps: " + number_text(rounded(f0->f0)) +
                               (f0->is_certain ? "" : " (uncertain: too few texels)") + "; " +
                               number_text(f0_of(chosen, *f0)) + " is used");
  if (metallic.texel_count == 0) return;
  const double difference = kPictureOfResidual * metallic.rms_residual();
  const auto percent = [](double share, int decimals) { return fixed(100.0 * share, decimals) + " %"; };
  if (difference >= kVisible)
    print_message(program,
                  place + "metal-rough cannot express these maps exactly; the visible difference is about " +
                      percent(difference, 0) + " (--diagnose DIR shows where)");
  if (!verbose) return;
  const auto share = [&](std::size_t count) {
    return percent(static_cast<double>(count) / static_cast<double>(metallic.texel_count), 2);
  };
  print_message(program, place + "residual of metal-rough: " + fixed(metallic.rms_residual(), 4) + " rms, " +
                             fixed(static_cast<double>(metallic.largest_residual), 3) + " at most");
  print_message(program,
                place + "metallic undetermined, no visible effect: " + share(metallic.undetermined.count) +
                    " (too dark: " + share(metallic.dark.count) + "); ambiguous: " +
                    share(metallic.ambiguous.count) + "; clamped: " + share(metallic.clamped.count));
}

}  // namespace

// The kinds of warnings of a folder: what they say after the name of a file.
class WarningKinds {
 public:
  // Whether the warning is one of the first of its kind, and its kind one of the first kinds.
  bool is_new(const std::string& warning) {
    const std::size_t colon = warning.find(": ");
    const std::string kind = colon == std::string::npos ? warning : warning.substr(colon + 2);
    if (counts_.contains(kind) || counts_.size() < kShownKinds) return ++counts_[kind] <= kShownOfKind;
    ++unshown_;
    return false;
  }
  std::size_t repeated() const {
    std::size_t more = unshown_;
    for (const auto& [kind, count] : counts_) more += count - std::min(count, kShownOfKind);
    return more;
  }

 private:
  static constexpr std::size_t kShownKinds = 20, kShownOfKind = 3;
  std::map<std::string, std::size_t> counts_;
  std::size_t unshown_ = 0;
};

Told::Told() : warnings(std::make_shared<WarningKinds>()) {}

void print_job(const std::string& program, const Outcome& outcome, const JobReport& report,
               const Told& told) {
  if (told.failures_only && !report.failure) return;
  std::string place = report.name.empty() ? "" : shown(report.name) + ": ";
  if (!report.tiles.empty()) place += counted(report.tiles.size(), outcome.list.tile_noun) + ": ";
  if (!told.failures_only)
    for (const std::string& warning : report.warnings)
      if (told.verbose || !outcome.list.is_tree || told.warnings->is_new(warning))
        print_message(program, "warning: " + warning);
  if (report.failure) {
    print_message(program, place + "failed: " + *report.failure);
    return;
  }
  if (report.was_done) return;
  if (outcome.dry_run) {
    print_message(program, place + "would write " + files_text(report) + " from " +
                               counted(report.inputs.size(), "file") +
                               " (first: " + report.inputs.front().string() + ")");
    if (!outcome.is_json) std::cout << plan_table(report.plan);
    return;
  }
  const MapStatistics& counts = report.statistics;
  const auto line = [&](std::size_t count, const std::string& what, const char* noun = "texel") {
    if (count > 0) print_message(program, place + counted(count, noun) + what);
  };
  const std::string by = outcome.list.is_tree ? "" : " by " + converter_text(outcome.chosen);
  if (counts.texel_count == 0) print_message(program, place + "copied: " + files_text(report));
  line(counts.texel_count, " in " + seconds_text(report.seconds) + by + ": " + files_text(report));
  if (told.verbose && !report.left_behind.empty()) print_message(program, place + left_behind_text(report));
  print_confidence(program, place, outcome.chosen, report, told.verbose);
  const auto is_told = [&](std::size_t count) {
    return told.verbose || !outcome.list.is_tree ||
           static_cast<double>(count) >= kVisible * static_cast<double>(counts.texel_count);
  };
  const auto visible_line = [&](std::size_t count, const std::string& what, const char* noun = "texel") {
    if (is_told(count)) line(count, what, noun);
  };
  if (told.verbose)
    line(counts.masked_count, " with an opacity of 0, which are converted and do not count here");
  visible_line(counts.above_one_count,
               " reflect more than 1; clamped to 1 (put emission into a map for itself)");
  visible_line(counts.out_of_domain_count, " outside " + outside_text(outcome.chosen) +
                                               ": roughness clamped, specular extrapolated in proportion");
  line(counts.nan_count, " with NaN" + first_text(counts));
  line(counts.infinite_count, " with infinite values" + first_text(counts));
  line(counts.negative_count, " with negative values" + first_text(counts));
  visible_line(counts.clipped_count, " clipped to [0, 1] by an integer pixel type", "value");
}

void print_colors(const std::string& program, const Outcome& outcome) {
  std::vector<std::pair<std::string, std::size_t>> phrases;  // reasons that read the same are one phrase
  for (const bool is_written : {false, true})
    for (const auto& [note, count] : outcome.colors()) {
      if (note.is_written != is_written) continue;
      std::string phrase = std::string(parameter_name(note.color)) +
                           (is_written ? " written as " : " read as ") +
                           std::string(name_of(kTransfers, note.transfer));
      if (note.reason == TransferReason::kUser)
        phrase += is_written ? " (--output-color-space)" : " (--color-space)";
      if (note.reason == TransferReason::kFile && note.transfer != Transfer::kSrgb)
        phrase += is_written ? " (as the map that it follows)" : " (tagged so by the file)";
      const auto known = std::find_if(phrases.begin(), phrases.end(),
                                      [&](const auto& entry) { return entry.first == phrase; });
      if (known == phrases.end())
        phrases.emplace_back(phrase, count);
      else
        known->second += count;
    }
  std::string text;
  for (const auto& [phrase, count] : phrases)
    text +=
        (text.empty() ? "" : ", ") + phrase + (outcome.list.is_tree ? " in " + counted(count, "map") : "");
  if (text.empty()) return;
  print_message(program, "color: " + text + "; --color-space and --output-color-space change this");
}

void print_left_out(const std::string& program, const JobList& list, bool failures_only) {
  for (const SkippedSet& entry : list.left_out)
    if (entry.is_failure || !failures_only)
      print_message(program, (entry.is_failure ? "failed: " : "skipped: ") + entry.message);
}

void print_unrecognised(const std::string& program, const JobList& list) {
  constexpr std::size_t kShown = 20;
  const std::size_t count = list.unrecognised.size();
  for (std::size_t i = 0; i < std::min(count, kShown); ++i)
    print_message(program, "not recognised: " + list.unrecognised[i].string());
  if (count == 0) return;
  print_message(program, counted(count, "image") + " left out, because no habit knows the name" +
                             (count > kShown ? "; --json lists all" : "") + " (--names FILE teaches one)");
}

void print_summary(const std::string& program, const Outcome& outcome, const Told& told) {
  if (!outcome.list.is_tree) return;
  if (const std::size_t more = told.warnings->repeated(); more > 0)
    print_message(program, counted(more, "more warning") + " of the same kinds (--verbose lists them)");
  print_unrecognised(program, outcome.list);
  if (const std::size_t assets = outcome.list.asset_count; assets > 0)
    print_message(program,
                  counted(assets, "asset") + " left out (--assets converts assets in place of sets)");
  std::size_t texels = 0, done = 0, done_before = 0;
  for (const JobReport& report : outcome.reports) {
    done += !report.failure && !report.was_done;
    done_before += report.was_done;
    texels += report.statistics.texel_count;
  }
  std::string text = counted(done, "set") + (outcome.dry_run ? " would be converted by " : " converted by ") +
                     converter_text(outcome.chosen) + ", " + std::to_string(outcome.failed_count()) +
                     " failed";
  if (done_before > 0) text += ", " + std::to_string(done_before) + " done before";
  if (!outcome.dry_run)
    text += "; " + counted(texels, "texel") + " in " + seconds_text(outcome.seconds) + ", " +
            seconds_text(outcome.used.processor_seconds) + " of processor time";
  print_message(program, text);
}

}  // namespace remap
