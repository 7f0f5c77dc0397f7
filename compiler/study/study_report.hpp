// The results of a study, ready to be printed and written.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/json.hpp"
#include "renderer/image.hpp"

namespace remap {

struct StudyReport {
  std::string summary;                                      // text for the terminal
  Json figures;                                             // the same for programs
  std::vector<std::pair<std::string, std::string>> tables;  // file name and CSV text
  std::vector<std::pair<std::string, std::string>> plots;   // file name of the SVG and commands for gnuplot
  std::vector<std::pair<std::string, Image>> sheets;        // file name and display values
};

// Figures with the names that they have in tables and in JSON.
class NamedFigures {
 public:
  using Entry = std::pair<const char*, double>;
  NamedFigures(std::initializer_list<Entry> entries) : entries_(entries) {}

  // The names, separated by commas.
  std::string header() const {
    std::string text;
    for (const auto& [name, value] : entries_) text += (text.empty() ? "" : ",") + std::string(name);
    return text;
  }
  std::vector<double> values() const {
    std::vector<double> all;
    for (const auto& [name, value] : entries_) all.push_back(value);
    return all;
  }
  Json json() const {
    Json object;
    for (const auto& [name, value] : entries_) object[name] = value;
    return object;
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace remap
