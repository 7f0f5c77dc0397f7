#include "commands/convert_report.hpp"

#include <array>
#include <cstdio>
#include <iomanip>
#include <iostream>

#include "command_line/run_app.hpp"
#include "commands/converter_text.hpp"

namespace remap {
namespace {

using Content = TargetChannel::Content;

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

bool holds(const TargetMap& target, Content content) {
  for (const TargetChannel& channel : target.channels)
    if (channel.content == content) return true;
  return false;
}

// The file that holds it; null where there is none.
Json file_json(const Outcome& outcome, Content content) {
  for (const TargetMap& target : outcome.targets)
    if (holds(target, content)) return target.writer.path().string();
  return {};
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

}  // namespace

void print_summary(const std::string& program, const Outcome& outcome) {
  const MapStatistics& counts = outcome.statistics;
  const auto line = [&](std::size_t count, const std::string& what) {
    if (count > 0) print_message(program, std::to_string(count) + what);
  };
  std::array<char, 32> seconds;
  std::snprintf(seconds.data(), seconds.size(), "%.2f", outcome.seconds);
  std::string files;
  for (const TargetMap& target : outcome.targets)
    files += (files.empty() ? "" : ", ") + target.writer.path().string();
  line(counts.texel_count, " texels in " + std::string(seconds.data()) + " s by " +
                               converter_text(outcome.chosen) + ": " + files);
  line(counts.out_of_domain_count, " texels outside " + outside_text(outcome.chosen) +
                                       ": width clamped, specular extrapolated in proportion");
  line(counts.nan_count, " texels with NaN" + first_text(counts));
  line(counts.infinite_count, " texels with infinite values" + first_text(counts));
  line(counts.negative_count, " texels with negative values" + first_text(counts));
  line(counts.clipped_count, " values clipped to [0, 1] by an integer pixel type");
}

void print_json(const Outcome& outcome) {
  const MapStatistics& counts = outcome.statistics;
  Json result = converter_json(outcome.chosen);
  result["roughness"] = file_json(outcome, Content::kRoughness);
  result["specular"] = file_json(outcome, Content::kSpecular);
  result["mask"] = file_json(outcome, Content::kMask);
  result["specular_color_space"] = transfer_name(outcome.set.specular.transfer);
  result["texels"] = counts.texel_count;
  result["out_of_domain"] = counts.out_of_domain_count;
  result["nan"] = counts.nan_count;
  result["infinite"] = counts.infinite_count;
  result["negative"] = counts.negative_count;
  result["first_bad"] = counts.first_bad ? Json{counts.first_bad->x, counts.first_bad->y} : Json();
  result["clipped_values"] = counts.clipped_count;
  result["values"] = {
      {"roughness",
       {{"source", values_json(counts.roughness)}, {"target", values_json(counts.roughness_out)}}},
      {"specular", {{"source", values_json(counts.specular)}, {"target", values_json(counts.specular_out)}}}};
  result["instructions"] = std::string(instruction_set_name(outcome.chosen.converter->info().instructions));
  result["seconds"] = outcome.seconds;
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
