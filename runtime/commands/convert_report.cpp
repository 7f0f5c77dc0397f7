#include "commands/convert_report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iomanip>
#include <iostream>

#include "command_line/run_app.hpp"
#include "commands/converter_text.hpp"

namespace remap {
namespace {

// The id of one converter; the models of a path.
std::string converter_text(const ChosenConverter& chosen) {
  if (chosen.path.steps.size() == 1) return chosen.converter->info().id;
  return models_text(chosen.path) + " (expected error " + expected_text(chosen.path.expected_error) + ")";
}

// What texels were outside of.
std::string outside_text(const ChosenConverter& chosen) {
  const std::string domain = domain_text(chosen.converter->info());
  if (chosen.path.steps.size() == 1) return domain;
  return "what one of the steps covers (the path: " + domain + ")";
}

std::string first_text(const MapStatistics& counts) {
  if (!counts.first_bad) return "";
  return "; the first bad texel is (" + std::to_string(counts.first_bad->x) + ", " +
         std::to_string(counts.first_bad->y) + ")";
}

// The file that holds it; null where there is none.
Json file_json(const JobReport& report, bool JobReport::Result::*content) {
  for (const JobReport::Result& result : report.results)
    if (result.*content) return result.path.string();
  return {};
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

Json converter_json(const ChosenConverter& chosen) {
  const ConverterInfo& info = chosen.converter->info();
  return {{"converter", info.id},
          {"path", path_json(chosen.path)},
          {"expected_error", chosen.path.expected_error},
          {"source", info.source.model},
          {"target", info.target.model}};
}

void print(const Json& json) {
  // File names need not be UTF-8.
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string seconds_text(double seconds) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.2f s", seconds);
  return text.data();
}

std::string files_text(const JobReport& report) {
  constexpr std::size_t kShown = 3;
  const std::vector<JobReport::Result>& results = report.results;
  std::string text;
  for (std::size_t i = 0; i < std::min(results.size(), kShown); ++i)
    text += (i == 0 ? "" : ", ") + results[i].path.string();
  if (results.size() > kShown) text += " and " + std::to_string(results.size() - kShown) + " more";
  if (!report.copies.empty())
    text += (report.copies.size() == 1 ? ", and a copy of " : ", and copies of ") +
            counted(report.copies.size(), "other file");
  return text;
}

Json counts_json(const MapStatistics& counts) {
  return {{"texels", counts.texel_count},
          {"out_of_domain", counts.out_of_domain_count},
          {"nan", counts.nan_count},
          {"infinite", counts.infinite_count},
          {"negative", counts.negative_count},
          {"first_bad", counts.first_bad ? Json{counts.first_bad->x, counts.first_bad->y} : Json()},
          {"clipped_values", counts.clipped_count}};
}

Json job_json(const JobReport& report) {
  using Result = JobReport::Result;
  const MapStatistics& counts = report.statistics;
  Json json = {{"roughness", file_json(report, &Result::roughness)},
               {"specular", file_json(report, &Result::specular)},
               {"mask", file_json(report, &Result::mask)},
               {"copies", paths_json(report.copies)},
               {"specular_color_space", transfer_name(report.specular_transfer)}};
  json.update(counts_json(counts));
  json["values"] = {
      {"roughness",
       {{"source", values_json(counts.roughness)}, {"target", values_json(counts.roughness_out)}}},
      {"specular", {{"source", values_json(counts.specular)}, {"target", values_json(counts.specular_out)}}}};
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

// Of one set among many.
Json set_json(const JobReport& report, bool dry_run) {
  Json json = {{"name", report.name},
               {"state", state_text(report, dry_run)},
               {"failure", report.failure ? Json(*report.failure) : Json()},
               {"tiles", report.tiles},
               {"results", Json::array()},
               {"inputs", paths_json(report.inputs)}};
  for (const JobReport::Result& result : report.results) json["results"].push_back(result.path.string());
  json.update(job_json(report));
  return json;
}

Json tree_json(const Outcome& outcome) {
  Json sets = Json::array(), left_out = Json::array();
  for (const JobReport& report : outcome.reports) sets.push_back(set_json(report, outcome.dry_run));
  for (const LeftOut& entry : outcome.list.left_out)
    left_out.push_back({{"message", entry.message}, {"is_failure", entry.is_failure}});
  return {{"sets", sets}, {"left_out", left_out}, {"unrecognised_images", outcome.list.unrecognised_count}};
}

}  // namespace

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
    print_message(program, place + "would make " + files_text(report) + " of " +
                               counted(report.inputs.size(), "file") + ", the first " +
                               report.inputs.front().string());
    return;
  }
  const MapStatistics& counts = report.statistics;
  const auto line = [&](std::size_t count, const std::string& what) {
    if (count > 0) print_message(program, place + std::to_string(count) + what);
  };
  const std::string by = outcome.list.is_tree ? "" : " by " + converter_text(outcome.chosen);
  line(counts.texel_count, " texels in " + seconds_text(report.seconds) + by + ": " + files_text(report));
  line(counts.out_of_domain_count, " texels outside " + outside_text(outcome.chosen) +
                                       ": width clamped, specular extrapolated in proportion");
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
    print_message(program, (entry.is_failure ? "failed: " : "left out: ") + entry.message);
  std::string text = counted(done, "set") + (outcome.dry_run ? " would be converted by " : " converted by ") +
                     converter_text(outcome.chosen) + ", " + std::to_string(outcome.failed_count()) +
                     " failed";
  if (done_before > 0) text += ", " + std::to_string(done_before) + " done before";
  if (!outcome.dry_run)
    text += "; " + std::to_string(texels) + " texels in " + seconds_text(outcome.seconds) + ", " +
            seconds_text(outcome.used.processor_seconds) + " of processor time";
  if (outcome.list.unrecognised_count > 0)
    text +=
        "; " + counted(outcome.list.unrecognised_count, "image") + " that no naming habit knows left alone";
  print_message(program, text);
}

void print_json(const Outcome& outcome) {
  Json result = converter_json(outcome.chosen);
  result.update(outcome.list.is_tree ? tree_json(outcome) : job_json(outcome.reports.front()));
  result["instructions"] = std::string(instruction_set_name(outcome.chosen.converter->info().instructions));
  result["seconds"] = outcome.seconds;
  result["processor_seconds"] = outcome.used.processor_seconds;
  result["peak_memory_bytes"] = outcome.used.peak_memory_bytes;
  print(result);
}

void print_values(const ChosenConverter& chosen, const std::string& roughness_name,
                  const ConvertedValues& values, bool json) {
  const std::string& specular_name = chosen.converter->info().target.specular;
  if (json) {
    Json result = converter_json(chosen);
    result["values"] = {{roughness_name, values.roughness}, {specular_name, values.specular}};
    result["in_domain"] = values.in_domain;
    print(result);
    return;
  }
  // Six digits are what a float holds, and more than any map.
  std::cout << std::setprecision(6) << roughness_name << " " << values.roughness << "\n" << specular_name;
  for (const float value : values.specular) std::cout << " " << value;
  std::cout << "\n";
}

}  // namespace remap
