#include "texremap/run/job_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "sets/folder_walk.hpp"

namespace remap {

JobReport JobReport::of(const Job& job) {
  JobReport report;
  report.name = job.name;
  if (!job.tile.empty()) report.tiles = {job.tile};
  if (const auto* asset = std::get_if<AssetWork>(&job.work)) report.inputs = {asset->input};
  return report;
}

JobReport& JobReport::operator+=(const JobReport& other) {
  const auto append = [](auto& all, const auto& more) {
    for (const auto& entry : more)
      if (!contains(all, entry)) all.push_back(entry);
  };
  append(tiles, other.tiles);
  append(inputs, other.inputs);
  append(copies, other.copies);
  append(left_behind, other.left_behind);
  append(warnings, other.warnings);
  results.insert(results.end(), other.results.begin(), other.results.end());
  was_done = was_done && other.was_done;
  has_compression_level = has_compression_level || other.has_compression_level;
  if (other.failure) failure = failure ? *failure + "; " + *other.failure : other.failure;
  if (!is_retryable(failure_code)) failure_code = other.failure_code;
  for (const auto& [note, count] : other.colors) colors[note] += count;
  if (plan.empty()) plan = other.plan;
  if (!estimated_f0) estimated_f0 = other.estimated_f0;
  statistics += other.statistics;
  seconds += other.seconds;
  bytes_read += other.bytes_read;
  bytes_written += other.bytes_written;
  return *this;
}

double used_f0(const DielectricF0& estimated) { return std::round(estimated.f0 * 1e4) / 1e4; }

std::optional<std::string> JobReport::failure_text() const {
  const std::size_t failed = count(MaterialState::kFailed);
  if (failure || failed == 0) return failure;
  const std::size_t all = materials.size() - count(MaterialState::kUntouched);
  return (failed == all ? "" : std::to_string(failed) + " of ") + counted(all, "material") + " failed";
}

namespace {

std::string name_of_file(const std::filesystem::path& file) { return display_path(file.filename()); }

std::string input_of(const TextureSet& set, const SetParameter& parameter) {
  if (!parameter.is_map())
    return joined(parameter.constants, ",", [](float value) { return number_text(decimal_value(value)); });
  const ImageReader& map = set.maps[parameter.channels.front().map];
  const auto& all = map.layout().channels;
  std::string text = name_of_file(map.path());
  if (parameter.channels.size() == std::min<std::size_t>(3, all.size()) &&
      parameter.channels.front().channel == 0 && (parameter.channels.size() > 1 || all.size() == 1))
    return text;  // alpha is not part of the map's values
  for (std::size_t c = 0; c < parameter.channels.size(); ++c)
    text += (c == 0 ? ":" : ",") + all[parameter.channels[c].channel].name;
  return text;
}

// Returns the files with a channel that `is_of` accepts.
template <typename IsOf>
std::string outputs_of(const TargetPlan& plan, IsOf is_of) {
  std::string text;
  for (const auto* files : {&plan.maps, &plan.copies})
    for (const PlannedFile& file : *files)
      if (std::ranges::any_of(
              file.parts, [&](const TargetPart& part) { return std::ranges::any_of(part.channels, is_of); }))
        text += (text.empty() ? "" : ", ") + name_of_file(file.path);
  return text;
}

std::string output_of(const TargetPlan& plan, Parameter parameter) {
  return outputs_of(plan, [parameter](const TargetChannel& channel) {
    const auto* converted = std::get_if<ConvertedChannel>(&channel);
    return converted != nullptr && converted->parameter == parameter;
  });
}

}  // namespace

std::vector<PlannedRole> planned_roles(const TextureSet& set, const TargetPlan& plan,
                                       const TargetChoice& choice, const SetWork& work,
                                       RoughnessEncoding own_width, RoughnessEncoding width) {
  std::vector<PlannedRole> roles;
  const auto width_text = [&](const std::string& happens) {
    const RoughnessEncoding own = set.convention.value_or(own_width);
    return own == width ? happens : happens + " to " + std::string(encoding_name(width));
  };
  const auto is_planned = [&](Parameter parameter) { return contains(choice.parameters, parameter); };
  for (const auto& [parameter, values] : set.parameters) {
    if (is_input(parameter) && !values.is_map() && !is_planned(parameter)) continue;  // usually a default
    const bool is_kept = contains(choice.unchanged, parameter);
    const bool is_target = is_planned(parameter);
    const bool is_width = parameter == Parameter::kRoughness;
    PlannedRole role{plain_name(parameter), input_of(set, values), "",
                     is_kept     ? "kept"
                     : is_target ? "converted"
                                 : "read",
                     output_of(plan, parameter)};
    if (is_width) role.encoding = encoding_name(set.convention.value_or(own_width));
    if (is_width && is_target) role.happens = width_text(is_kept ? "encoded" : role.happens);
    if (is_color(parameter) && values.is_map()) role.encoding = name_of(kTransfers, values.transfer);
    roles.push_back(std::move(role));
  }
  for (const Parameter parameter : choice.parameters)
    if (!set.parameters.contains(parameter))
      roles.push_back({plain_name(parameter), "", "", "made", output_of(plan, parameter)});
  for (const Carried<SetParameter>& carried : set.carried) {
    const auto* place = carried.parameter.is_map() ? &carried.parameter.channels.front() : nullptr;
    roles.push_back({carried.name, input_of(set, carried.parameter), "", "carried",
                     outputs_of(plan, [&](const TargetChannel& channel) {
                       const auto* copied = std::get_if<ChannelPlace>(&channel);
                       return place != nullptr && copied != nullptr && *copied == *place;
                     })});
  }
  for (const PlannedFile& copy : plan.copies)
    if (copy.parts.empty())
      roles.push_back({"", name_of_file(copy.source), "", copy.turns_green ? "green inverted" : "copied",
                       name_of_file(copy.path)});
  for (const std::filesystem::path& file : work.left_behind)
    roles.push_back({"", name_of_file(file), "", "left behind", ""});
  return roles;
}

std::string plan_table(const std::vector<PlannedRole>& roles) {
  std::vector<std::array<std::string, 5>> rows = {{"role", "file", "holds", "what happens", "output"}};
  for (const PlannedRole& role : roles)
    rows.push_back({role.role, role.input, role.encoding, role.happens, role.output});
  // Names of channels and roles come from files, so they must be made safe to print, too.
  for (auto& row : rows)
    for (std::string& cell : row) cell = plain(cell);
  std::array<std::size_t, 5> widths{};
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string text;
  for (const auto& row : rows) {
    std::string line = " ";
    for (std::size_t c = 0; c < row.size(); ++c)
      line += " " + padded(row[c].empty() ? "-" : row[c], widths[c]) + " ";
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace remap
