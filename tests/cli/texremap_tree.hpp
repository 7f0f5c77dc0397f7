// This file writes a folder of texture sets that texremap converts.
#pragma once

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/texremap_session.hpp"

namespace remap {

// Returns the lines of a folder's report as one object: the sets by name, what was skipped, the conversion
// and the summary.
inline nlohmann::json tree_report(const std::string& output) {
  nlohmann::json report = {{"sets", nlohmann::json::array()}, {"skipped", nlohmann::json::array()}};
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    if (json.contains("set")) report["sets"].push_back(json["set"]);
    if (json.contains("skipped")) report["skipped"].push_back(json["skipped"]);
    for (const char* name : {"conversion", "summary"})
      if (json.contains(name)) report[name] = json[name];
  }
  auto& sets = report["sets"];
  std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a["name"] < b["name"]; });
  return report;
}

// Returns the states of the sets by their first letters: c (converted), d (done before), f (failed).
inline std::string set_states(const std::string& output) {
  std::string letters;
  const auto report = tree_report(output);
  for (const auto& set : report["sets"]) letters += set["state"].get<std::string>().front();
  return letters;
}

inline constexpr int kTreeMapSize = 24;

class Tree : public Session {
 public:
  void map(const std::string& name, const std::vector<std::string>& channels,
           OIIO::TypeDesc type = OIIO::TypeUInt8, int size = kTreeMapSize) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    write_image(path(name), test_spec(size, size, channels, type), noise);
  }
  ProcessResult convert_tree(const Words& more = {}, const ProcessLimits& limits = {}) const {
    return texremap(kConversion + " in --color-space linear" + more, limits);
  }
  // Returns every file below `out` except the journal, relative to `out`.
  std::vector<std::string> results() const {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path("out"), none))
      if (entry.is_regular_file() && entry.path().filename() != kJournal)
        names.push_back(std::filesystem::relative(entry.path(), path("out")).string());
    std::sort(names.begin(), names.end());
    return names;
  }
};

inline const std::vector<std::string> kGrey = {"Y"}, kColor = {"R", "G", "B"},
                                      kWithAlpha = {"R", "G", "B", "A"};

}  // namespace remap
