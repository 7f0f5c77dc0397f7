#include "texremap/part_report.hpp"

#include <algorithm>
#include <iostream>
#include <unordered_map>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/report_text.hpp"
#include "core/system.hpp"
#include "remap/version.hpp"
#include "sets/folder_walk.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// As texremap plan makes at most.
constexpr std::size_t kMostReports = 1'000'000;

// Many of one kind are told by the first few and their number.
constexpr std::size_t kNamed = 8;

std::string named(const std::vector<std::string>& all) {
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), kNamed); ++i) text += (i == 0 ? "" : ", ") + all[i];
  return all.size() > kNamed ? text + " and " + std::to_string(all.size() - kNamed) + " more" : text;
}

// Reads the reports one after another and compares them.
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
  void add_set(const Part& part, const Field& set);
  void add_asset(const Part& part, const Field& asset);
  void count(const std::string& name, const std::string& failure, bool was_done);
  void require_once(const Part& part, const std::string& what, const std::string& name);
  void problem(const std::string& text) { merged_.problems.push_back(text); }

  const fs::path output_, folder_;
  const std::function<void(std::string_view)>& take_;
  MergedReport merged_;
  std::map<std::string, std::string> first_;  // what the first report says of its run
  Part first_part_;
  std::size_t lines_of_part_ = 0;                         // about sets, in the report that is being read
  std::unordered_map<std::string, std::size_t> part_of_;  // of a set or result, by its name
  std::map<std::string, std::pair<std::size_t, std::string>>
      twice_;  // by a pair of parts: how many, the first
};

std::vector<Part> ReportMerger::parts_found() const {
  std::vector<Part> parts;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, failure))
    if (const auto part = part_named(entry.path().stem().string());
        part && part->count <= kMostReports && entry.path().extension() == kPartReport)
      parts.push_back(*part);
  std::ranges::sort(parts, {}, [](const Part& part) { return std::pair(part.count, part.index); });
  if (parts.empty())
    throw input_error(output_.string() +
                      ": holds no report of a part (texremap convert --manifest FILE --part "
                      "I/N writes one when it has finished)");
  return parts;
}

void ReportMerger::compare(const Part& part, const Field& said) {
  std::map<std::string, std::string> own;
  for (const char* name : {"manifest", "version", "converter", "options", "conversion"})
    if (said.contains(name)) own[name] = said[name].any_text();
  if (said["index"].count() != static_cast<std::int64_t>(part.index) ||
      said["count"].count() != static_cast<std::int64_t>(part.count))
    problem(name_of(part) + kPartReport + ": is the report of another part (convert this one again)");
  if (first_.empty()) {
    first_ = own;
    first_part_ = part;
    merged_.kind = said.contains("assets") ? ListedKind::kAssets : ListedKind::kSets;
    merged_.entry_count =
        static_cast<std::size_t>(said[std::string(name_of(kListedKinds, merged_.kind))].count());
    return;
  }
  for (const auto& [name, value] : own)
    if (first_[name] != value) {
      problem(name_of(part) + ": " + name + " " + value + ", but " + name_of(first_part_) + " has " +
              first_[name] + " (convert one of them again)");
      return;
    }
}

// Names each pair of parts once, with the first case.
void ReportMerger::require_once(const Part& part, const std::string& what, const std::string& name) {
  const auto [found, is_new] = part_of_.try_emplace(what + name, part.index);
  if (is_new) return;
  auto& [count, first] =
      twice_[what + " in " + name_of(Part{found->second, part.count}) + " and in " + name_of(part)];
  if (count++ == 0) first = name;
}

// `failure`: empty for none.
void ReportMerger::count(const std::string& name, const std::string& failure, bool was_done) {
  if (!failure.empty()) {
    ++merged_.failed;
    merged_.failures.push_back(shown(name) + ": " + failure);
    return;
  }
  ++(was_done ? merged_.done_before : merged_.converted);
}

void ReportMerger::add_asset(const Part& part, const Field& asset) {
  const std::string& name = asset["asset"].any_text();
  require_once(part, "asset", name);
  const std::int64_t failed_materials = asset["failed"].count();
  std::string failure;
  if (asset["failure"].json().text() != nullptr) failure = asset["failure"].any_text();
  if (failure.empty() && failed_materials > 0)
    failure = counted(static_cast<std::size_t>(failed_materials), "material") + " failed";
  count(name, failure, asset.flag("was_done"));
  asset["images"].list(0, [&](const Field& image) {
    require_once(part, "result", image.any_text());
    return true;
  });
}

void ReportMerger::add_set(const Part& part, const Field& set) {
  const std::string& name = set["name"].any_text();
  require_once(part, "set", name);
  const std::string& state = set["state"].any_text();
  const bool has_failed = state == "failed";
  if (has_failed || state == "converted" || state == "done before")
    count(name, has_failed ? set["failure"].any_text() : "", state == "done before");
  if (!has_failed)
    set["results"].list(0, [&](const Field& result) {
      require_once(part, "result", result.any_text());
      return true;
    });
  merged_.texels += static_cast<std::size_t>(set["texels"].count());
  merged_.bytes_read += static_cast<std::uintmax_t>(set["bytes_read"].count());
  merged_.bytes_written += static_cast<std::uintmax_t>(set["bytes_written"].count());
}

void ReportMerger::add(const Part& part, const Field& line, std::string_view text) {
  if (line.contains("part")) compare(part, line["part"]);
  if (line.contains("summary")) {
    const Field summary = line["summary"];
    merged_.processor_seconds += summary["processor_seconds"].number();
    constexpr std::int64_t kMost = std::int64_t{1} << 40;  // whose sum is a number, too
    std::int64_t stated = 0;
    if (merged_.kind == ListedKind::kSets) {
      stated = std::min(summary["sets"].count(), kMost) + std::min(summary["left_out"].count(), kMost);
    } else {
      stated = summary["assets"].count();
      summary["problems"].list(0, [&](const Field& problem) {
        ++merged_.failed;
        merged_.failures.push_back(problem.any_text());
        return true;
      });
    }
    if (stated != static_cast<std::int64_t>(lines_of_part_))
      throw input_error(name_of(part) + kPartReport + ": is incomplete");
  }
  const bool is_set = line.contains("set"), is_asset = line.contains("asset"),
             is_left_out = line.contains("left_out");
  lines_of_part_ += is_set || is_asset || is_left_out;
  if (is_set) add_set(part, line["set"]);
  if (is_asset) add_asset(part, line);
  if (is_left_out) {
    const bool is_failure = line["left_out"].flag("is_failure");
    is_failure ? ++merged_.failed : ++merged_.left_out;
    if (is_failure) merged_.failures.push_back(line["left_out"]["message"].any_text());
  }
  if (is_set || is_asset || is_left_out) take_(text);
}

void ReportMerger::read(const Part& part) {
  const std::string name = name_of(part) + kPartReport;
  lines_of_part_ = 0;
  try {
    const OwnedFile file(output_, fs::path(kPartsFolder) / name, OwnFile::kRead);
    if (!file.exists()) throw input_error(name + ": is incomplete");  // removed meanwhile
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
    problem("there are reports of " + std::to_string(parts.front().count) + " and of " +
            std::to_string(parts.back().count) + " parts (remove those of the earlier run from " +
            folder_.string() + ")");
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
    problem("no report of " + counted(missing.size(), "part") + ": " + named(missing) +
            " (convert them again with --resume)");
  for (const auto& [where, cases] : twice_)
    problem("the same " + where + ": " + shown(cases.second) +
            (cases.first > 1 ? " and " + std::to_string(cases.first - 1) + " more" : "") + " (two " +
            noun_of(merged_.kind) + "s must not give one file: rename one)");
  return std::move(merged_);
}

}  // namespace

void RunLines::tell(const Json& line) {
  const std::string text = line.dump() + '\n';
  if (options_.json) std::cout << text << std::flush;
  if (options_.part) report_ += text;
}

void RunLines::finish() const {
  if (!options_.part || options_.dry_run) return;
  require_own_folder(options_.output / kPartsFolder);
  write_file(report_of(options_.output, options_.part->part), report_);
}

Json part_json(const GivenPart& part, const ManifestHead& manifest, const ConversionNote& conversion) {
  Json json = {{"index", part.part.index},
               {"count", part.part.count},
               {"manifest", manifest.hash},
               {std::string(name_of(kListedKinds, manifest.kind)), manifest.count},
               {"conversion", conversion.hash}};
  for (const auto& [name, value] : conversion.details) json[name] = value;
  json["host"] = machine_name();
  json["note"] = part.note;
  return {{"part", json}};
}

fs::path report_of(const fs::path& output, const Part& part) {
  return output / kPartsFolder / (name_of(part) + kPartReport);
}

MergedReport merge_reports(const fs::path& output, const std::function<void(std::string_view)>& take) {
  return ReportMerger(output, take).merge();
}

}  // namespace remap
