#include "texremap/report/part_report.hpp"

#include <algorithm>
#include <unordered_map>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/number_text.hpp"
#include "core/system.hpp"
#include "remap/version.hpp"
#include "sets/folder_walk.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// texremap plan never makes more parts.
constexpr std::size_t kMostReports = 1'000'000;

// Messages show this many cases of a kind, and then the number of all cases.
constexpr std::size_t kNamed = 8;

std::string named(const std::vector<std::string>& all) {
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), kNamed); ++i) text += (i == 0 ? "" : ", ") + all[i];
  return all.size() > kNamed ? text + " and " + std::to_string(all.size() - kNamed) + " more" : text;
}

// A ReportMerger reads the reports one after another and compares them.
class ReportMerger {
 public:
  ReportMerger(const fs::path& output, const std::function<void(std::string_view)>& take)
      : output_(output), folder_(output / kPartsFolder), take_(take) {}
  MergedReport merge();

 private:
  std::vector<Part> parts_found() const;
  void read(const Part& part);
  void compare(const Part& part, const Field& said);
  void add(const Part& part, const Field& line, std::string_view text);
  void add_entry(const Part& part, const Field& entry);
  void require_once(const Part& part, const std::string& what, const std::string& name);
  void problem(const std::string& text) { merged_.problems.push_back(text); }

  const fs::path output_, folder_;
  const std::function<void(std::string_view)>& take_;
  MergedReport merged_;
  std::map<std::string, std::string> first_;  // properties of the run in the first report
  Part first_part_;
  std::size_t lines_of_part_ = 0;                         // lines about sets in the current report
  std::unordered_map<std::string, std::size_t> part_of_;  // keyed by the name of a set or result
  std::map<std::string, std::pair<std::size_t, std::string>>
      twice_;  // keyed by a pair of parts: number of cases, and the first case
};

std::vector<Part> ReportMerger::parts_found() const {
  std::vector<Part> parts;
  std::error_code failure;
  if (!fs::exists(output_, failure))
    throw input_error(output_.string() + ": does not exist (give the output folder of the parts)");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, failure))
    if (const auto part = part_named(entry.path().stem().string());
        part && part->count <= kMostReports && entry.path().extension() == kPartReport)
      parts.push_back(*part);
  std::ranges::sort(parts, {}, [](const Part& part) { return std::pair(part.count, part.index); });
  if (parts.empty())
    throw input_error(
        output_.string() +
        ": contains no part reports (texremap convert --manifest FILE --part I/N writes one when it ends)");
  return parts;
}

void ReportMerger::compare(const Part& part, const Field& said) {
  std::map<std::string, std::string> own;
  for (const char* name : {"manifest", "version", "converter", "options", "conversion"})
    if (said.contains(name)) own[name] = said[name].any_text();
  if (said["index"].count() != static_cast<std::int64_t>(part.index) ||
      said["count"].count() != static_cast<std::int64_t>(part.count))
    problem(name_of(part) + kPartReport + ": is the report of another part (convert this part again)");
  if (first_.empty()) {
    first_ = own;
    first_part_ = part;
    merged_.kind = said.contains("assets") ? ListedKind::kAssets : ListedKind::kSets;
    merged_.entry_count =
        static_cast<std::size_t>(said[std::string(name_of(kListedKinds, merged_.kind))].count());
    return;
  }
  const auto shown = [](const std::string& value) { return value.empty() ? "none" : value; };
  for (const auto& [name, value] : own)
    if (first_[name] != value) {
      problem(name_of(part) + ": has " + name + " " + shown(value) + ", but " + name_of(first_part_) +
              " has " + shown(first_[name]) + " (convert one of these parts again)");
      return;
    }
}

// Reports each pair of parts once, with the first case.
void ReportMerger::require_once(const Part& part, const std::string& what, const std::string& name) {
  const auto [found, is_new] = part_of_.try_emplace(what + name, part.index);
  if (is_new) return;
  auto& [count, first] = twice_[name_of(Part{found->second, part.count}) + " and " + name_of(part) +
                                " contain the same " + what];
  if (count++ == 0) first = name;
}

// Adds a set or an asset.
void ReportMerger::add_entry(const Part& part, const Field& entry) {
  const std::string& name = entry["name"].any_text();
  require_once(part, noun_of(merged_.kind), name);
  const std::string& state = entry["state"].any_text();
  if (state == "failed") {
    ++merged_.failed;
    merged_.failures.push_back(display_path(name) + ": " + entry["failure"].any_text());
  } else {
    merged_.converted += state == "converted";
    merged_.done_before += state == "done before";
    entry["results"].list(0, [&](const Field& result) {
      require_once(part, "result", result.any_text());
      return true;
    });
  }
  if (entry.contains("texels")) merged_.texels += static_cast<std::size_t>(entry["texels"].count());
  merged_.bytes_read += static_cast<std::uintmax_t>(entry["bytes_read"].count());
  merged_.bytes_written += static_cast<std::uintmax_t>(entry["bytes_written"].count());
}

void ReportMerger::add(const Part& part, const Field& line, std::string_view text) {
  if (line.contains("part")) compare(part, line["part"]);
  if (line.contains("summary")) {
    const Field summary = line["summary"];
    merged_.processor_seconds += summary["processor_seconds"].number();
    constexpr std::int64_t kMost = std::int64_t{1} << 40;  // small enough for a sum over all parts
    const std::string entries(name_of(kListedKinds, merged_.kind));
    const std::int64_t stated =
        std::min(summary[entries].count(), kMost) + std::min(summary["skipped"].count(), kMost);
    if (stated != static_cast<std::int64_t>(lines_of_part_))
      throw input_error(name_of(part) + kPartReport + ": is incomplete");
  }
  const std::string noun = noun_of(merged_.kind);
  const bool is_entry = line.contains(noun), is_skipped = line.contains("skipped");
  lines_of_part_ += is_entry || is_skipped;
  if (is_entry) add_entry(part, line[noun]);
  if (is_skipped) {
    const bool is_failure = line["skipped"].flag("is_failure");
    is_failure ? ++merged_.failed : ++merged_.skipped;
    if (is_failure) merged_.failures.push_back(line["skipped"]["message"].any_text());
  }
  if (is_entry || is_skipped) take_(text);
}

void ReportMerger::read(const Part& part) {
  const std::string name = name_of(part) + kPartReport;
  lines_of_part_ = 0;
  try {
    const OwnedFile file(output_, fs::path(kPartsFolder) / name, OwnFile::kRead);
    if (!file.exists()) throw input_error(name + ": is incomplete");  // the file was removed meanwhile
    const InputFile content = file.content();
    InputLines lines(content);
    bool is_whole = false;
    while (const std::optional<std::string_view> line = lines.next()) {
      is_whole = line->starts_with("{\"summary\":");
      const Json json = parse_json(*line, name);
      add(part, Field(json, name), *line);
    }
    if (!is_whole || !lines.rest().empty()) throw input_error(name + ": is incomplete");
  } catch (const Error& error) {
    problem(std::string(error.what()) + " (convert this part again)");
  }
}

MergedReport ReportMerger::merge() {
  const std::vector<Part> parts = parts_found();
  merged_.part_count = parts.back().count;
  if (parts.front().count != parts.back().count)
    problem(folder_.string() + ": contains reports of runs with " + std::to_string(parts.front().count) +
            " and with " + std::to_string(parts.back().count) +
            " parts (remove the reports of the earlier run)");
  std::vector<bool> has(merged_.part_count, false);
  for (const Part& part : parts) {
    if (part.count != merged_.part_count) continue;
    has[part.index - 1] = true;
    read(part);
  }
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < has.size(); ++i)
    if (!has[i]) missing.push_back(std::to_string(i + 1));
  if (!missing.empty())
    problem(std::string(missing.size() == 1 ? "part " : "parts ") + named(missing) + " of " +
            std::to_string(has.size()) + ": no report found (convert " +
            (missing.size() == 1 ? "this part" : "these parts") + " again)");
  for (const auto& [where, cases] : twice_)
    problem(where + ": " + display_path(cases.second) +
            (cases.first > 1 ? " and " + std::to_string(cases.first - 1) + " more" : "") +
            " (rename one of the two " + noun_of(merged_.kind) + "s)");
  return std::move(merged_);
}

}  // namespace

void write_part_report(const fs::path& output, const Part& part, const std::string& lines) {
  require_own_folder(output / kPartsFolder);
  write_file(output / kPartsFolder / (name_of(part) + kPartReport), lines);
}

Json part_json(const Part& part, const ManifestHead& manifest, const ConversionNote& conversion) {
  Json json = {{"index", part.index},
               {"count", part.count},
               {"manifest", manifest.hash},
               {std::string(name_of(kListedKinds, manifest.kind)), manifest.count},
               {"conversion", conversion.hash}};
  for (const auto& [name, value] : conversion.details) json[name] = value;
  json["host"] = machine_name();
  json["note"] = part.note;
  return {{"part", json}};
}

MergedReport merge_reports(const fs::path& output, const std::function<void(std::string_view)>& take) {
  return ReportMerger(output, take).merge();
}

}  // namespace remap
