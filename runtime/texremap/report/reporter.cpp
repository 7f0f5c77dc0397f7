#include "texremap/report/reporter.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "remap/conversion.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/options/convert_options.hpp"
#include "texremap/plan/conversion_request.hpp"
#include "texremap/plan/converter_text.hpp"
#include "texremap/report/part_report.hpp"

namespace remap {
namespace {

void print_messages(const ConvertPlan& plan) {
  if (plan.quiet) return;
  for (const std::string& message : plan.messages) say(message);
}

// Prints JSON. File names need not be UTF-8.
void print(const Json& json) { std::cout << json.dump(2) << std::endl; }

void print_unrecognised(const JobList& list) {
  constexpr std::size_t kShown = 20;
  const std::size_t count = list.unrecognised.size();
  for (std::size_t i = 0; i < std::min(count, kShown); ++i)
    say("not recognised: " + list.unrecognised[i].string());
  if (count == 0) return;
  say(counted(count, "image") + " skipped, because no naming convention fits" +
      (count > kShown ? "; --json lists all" : "") + " (--names FILE adds one)");
}

void print_summary(const Outcome& outcome, const WarningKinds& warnings) {
  const ConvertPlan& plan = outcome.plan;
  const JobList& list = plan.list;
  if (const std::size_t more = warnings.repeated(); more > 0)
    say(counted(more, "more warning") + " of the same kinds (--verbose lists them)");
  print_unrecognised(list);
  if (list.asset_count > 0)
    say(counted(list.asset_count, "asset") + " skipped (--assets converts assets instead of sets)");
  std::size_t texels = 0, materials = 0, done = 0, done_before = 0;
  for (const JobReport& report : outcome.reports) {
    done += !report.failure_text() && !report.was_done;
    done_before += report.was_done;
    texels += report.statistics.texel_count;
    materials += report.count(MaterialState::kConverted);
  }
  const SetPlan* sets = plan.sets();
  if (plan.verbose && sets != nullptr) say("converter: " + converter_text(sets->chosen));
  if (plan.verbose && !plan.dry_run)
    say((sets == nullptr ? counted(materials, "material") : counted(texels, "texel")) + ", " +
        fixed(outcome.used.processor_seconds, 2) + " s of processor time");
  std::string text =
      counted(done, noun_of(list.kind)) + (plan.dry_run ? " would be converted" : " converted");
  if (sets != nullptr) text += " from " + sets->source_name + " to " + sets->target_name;
  if (!plan.dry_run) text += " in " + fixed(outcome.seconds, 2) + " s";
  text += ", " + std::to_string(outcome.failed_count()) + " failed";
  if (done_before > 0) text += ", " + std::to_string(done_before) + " done before";
  say(text);
}

// Throws if an entry failed. For a single asset, also throws if one of its materials failed.
void require_success(const Outcome& outcome) {
  const JobList& list = outcome.plan.list;
  const std::size_t all = outcome.reports.size() + list.skipped.size();
  const std::string of_all = " of " + counted(all, noun_of(list.kind)) + " ";
  if (const std::size_t failed = outcome.failed_count(); failed > 0) {
    if (!list.has_several)
      throw input_error(display_path(outcome.reports.front().name) + ": " +
                        *outcome.reports.front().failure_text());
    int passing = 0;  // errno of the first failure that may not happen in another run
    for (const JobReport& report : outcome.reports)
      if (passing == 0 && report.failure && is_retryable(report.failure_code)) passing = report.failure_code;
    throw Error(
        ErrorKind::kInput,
        (failed == all ? counted(all, noun_of(list.kind)) + " " : std::to_string(failed) + of_all) + "failed",
        passing);
  }
  if (outcome.reports.empty() && !list.skipped.empty() && !outcome.plan.part)
    throw input_error("no " + noun_of(list.kind) + " was converted (" +
                      counted(list.skipped.size(), noun_of(list.kind)) + " skipped for the " +
                      (list.skipped.size() == 1 ? "reason" : "reasons") + " above)");
}

// Returns the name of a target parameter. Roughness is called by its encoding.
std::string name_of_target(const BuiltConversion& chosen, Parameter parameter, RoughnessEncoding width) {
  if (parameter == Parameter::kRoughness) return std::string(encoding_name(width));
  if (!chosen.choice.is_material()) return chosen.info().target.specular;
  return std::string(parameter_name(parameter));
}

// A ConvertedNumbers is the result of a conversion of numbers.
struct ConvertedNumbers {
  std::string name;
  std::vector<float> channels;
  bool is_scalar = false;  // JSON shows a number, not a list
};

void print_numbers(const ConvertPlan& plan, const std::vector<ConvertedNumbers>& values, bool in_domain,
                   const std::vector<std::string>& lost = {}) {
  if (plan.json) {
    Json result = conversion_json(plan);
    if (plan.sets()->chosen.choice.translation) result["lost"] = lost;
    for (const ConvertedNumbers& value : values)
      result["values"][value.name] =
          value.channels.size() == 1 && value.is_scalar ? Json(value.channels.front()) : Json(value.channels);
    result["in_domain"] = in_domain;
    return print(result);
  }
  // Print six digits, the precision of a float.
  std::cout << std::setprecision(6);
  for (const ConvertedNumbers& value : values) {
    std::cout << value.name;
    for (const float channel : value.channels) std::cout << " " << channel;
    std::cout << "\n";
  }
}

}  // namespace

Reporter::Reporter(const ConvertPlan& plan) : plan_(plan) {
  print_messages(plan);
  for (const SkippedEntry& entry : plan.list.skipped)
    if (entry.is_failure || !plan.quiet) say((entry.is_failure ? "failed: " : "skipped: ") + entry.message);
  if (plan.part) write(part_json(*plan.part, plan.manifest, plan.conversion));
  write({{"conversion", conversion_json(plan)}});
  for (const SkippedEntry& entry : plan.list.skipped)
    write({{"skipped", {{"message", entry.message}, {"is_failure", entry.is_failure}}}});
}

void Reporter::write(const Json& line) {
  if (!plan_.list.has_several) return;
  const std::string text = line.dump() + '\n';
  if (plan_.json) std::cout << text << std::flush;
  if (plan_.part) lines_ += text;
}

void Reporter::add(const JobReport& report) {
  if (!plan_.list.has_several) return;  // finish() prints it, with the time of the whole run
  print_job(plan_, report, warnings_);
  write({{noun_of(plan_.list.kind), job_json(plan_, report)}});
}

void Reporter::finish(std::vector<JobReport> reports) {
  Outcome outcome{plan_, std::move(reports), stopwatch_.seconds(), resource_use()};
  const SetPlan* sets = plan_.sets();
  const std::string note = sets == nullptr ? "" : note_text(sets->chosen.path, sets->chosen.closer);
  if (!note.empty() && !plan_.quiet) say("note: " + note);
  if (!plan_.list.has_several) {
    JobReport& report = outcome.reports.front();
    report.seconds = outcome.seconds;
    print_job(plan_, report, warnings_);
    if (plan_.json) {
      Json result = conversion_json(plan_);
      result.update(job_json(plan_, report));
      result.update(run_json(outcome));
      print(result);
    }
  }
  if (!plan_.quiet) {
    print_colors(outcome.colors(), plan_.list.has_several);
    if (plan_.list.has_several) print_summary(outcome, warnings_);
  }
  write({{"summary", summary_json(outcome)}});
  if (plan_.part && !plan_.dry_run) write_part_report(plan_.output, *plan_.part, lines_);
  require_success(outcome);
}

namespace {

// Prints the inputs of the target that differ from their defaults.
void print_translated_numbers(const ConvertPlan& plan, const TranslationEffect& effect) {
  std::vector<ConvertedNumbers> values;
  for (const SurfaceValue& value : effect.values)
    values.push_back({value.name, value.values, value.values.size() == 1});
  const std::string& target = plan.sets()->chosen.info().target.model;
  if (!plan.quiet && !effect.lost.empty())
    say("warning: no effect in " + target + ": " + joined(effect.lost, ", "));
  if (!plan.quiet && values.empty()) say("note: all inputs of " + target + " have their defaults");
  print_numbers(plan, values, true, effect.lost);
}

}  // namespace

void print_converted_numbers(const ConvertPlan& plan) {
  print_messages(plan);
  const SetPlan& sets = *plan.sets();
  if (const auto effect = effect_of(sets.chosen.choice, sets.request))
    return print_translated_numbers(plan, *effect);
  const BuiltConversion& chosen = sets.chosen;
  const ConverterInfo& info = chosen.info();
  MapConversion maps;
  maps.width = maps.height = 1;
  for (const auto& [parameter, asked] : sets.request.parameters) {
    SourceParameter& source = maps.sources[parameter];
    source.constants = std::get<ConstantValues>(asked.source);
    source.factors = asked.factors;
    source.name = parameter_option(parameter);
  }
  maps.source_convention = sets.request.convention;
  maps.target_convention = sets.targets.treatment.target_convention;
  maps.target_roughness_factor = sets.targets.treatment.target_roughness_factor;
  if (!maps.target_convention && chosen.choice.is_material())
    maps.target_convention = width_of(*chosen.choice.target);
  maps.bad_texels = sets.targets.treatment.bad_texels;
  const RoughnessEncoding width = maps.target_convention.value_or(info.target.roughness);
  const auto specular = maps.sources.find(Parameter::kSpecular);
  std::vector<ConvertedNumbers> values;
  for (const Parameter parameter : chosen.converter().targets()) {
    if (parameter == Parameter::kMetallicIssues) continue;
    const std::size_t channels = chosen.converter().target_channels(
        parameter, specular == maps.sources.end() ? 3 : specular->second.constants.size());
    values.push_back(
        {name_of_target(chosen, parameter, width), std::vector<float>(channels), !is_color(parameter)});
    for (float& value : values.back().channels)
      maps.targets[parameter].channels.push_back(float_channel(&value, 1));
  }
  const bool in_domain = convert_maps(chosen.converter(), maps).out_of_domain_count == 0;
  if (!plan.quiet && !in_domain)
    say("warning: the values are outside the measured range (" + domain_text(chosen.domain()) + ")");
  const std::string note = note_text(chosen.path, chosen.closer);
  if (!plan.quiet && !note.empty()) say("note: " + note);
  print_numbers(plan, values, in_domain);
}

}  // namespace remap
