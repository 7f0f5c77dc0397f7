#include "commands/candidate_table.hpp"

#include <algorithm>

#include "core/number_text.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

const std::string kNone = "-";

std::string digits(double value) { return value == 0.0 ? kNone : error_text(value); }

using Line = std::vector<std::string>;

Line line_of(const CandidateRecord& candidate) {
  return {candidate.name,
          candidate.number_count == 0 ? kNone : std::to_string(candidate.number_count),
          candidate.pictures ? fixed(candidate.pictures->rmse, 2) : kNone,
          candidate.pictures ? fixed(candidate.pictures->relative, 3) : kNone,
          digits(candidate.relative_alpha),
          digits(candidate.relative_specular),
          digits(candidate.alpha.rms),
          digits(candidate.alpha.max),
          digits(candidate.specular.rms),
          digits(candidate.specular.max),
          candidate.verdict};
}

// Returns true if any line after the headings has a figure in `column`.
bool has_figures(const std::vector<Line>& lines, std::size_t column) {
  return std::any_of(lines.begin() + 1, lines.end(),
                     [column](const Line& line) { return line[column] != kNone; });
}

}  // namespace

std::string candidate_text(const std::vector<CandidateRecord>& candidates, const std::string& specular) {
  std::vector<Line> lines = {{"", "numbers", "RMSE %", "one light", "alpha relative", specular + " relative",
                              "alpha rms", "max", specular + " rms", "max", ""}};
  for (const CandidateRecord& candidate : candidates) lines.push_back(line_of(candidate));
  std::vector<std::size_t> widths(lines[0].size(), 0);
  for (const Line& line : lines)
    for (std::size_t column = 0; column < line.size(); ++column)
      widths[column] = std::max(widths[column], line[column].size());
  std::string text;
  for (const Line& line : lines) {
    std::string row = " ";
    for (std::size_t column = 0; column < line.size(); ++column)
      if (has_figures(lines, column))
        row += ' ' + line[column] + std::string(widths[column] - line[column].size() + 1, ' ');
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + '\n';
  }
  return text;
}

std::string errors_text(const Fit& fit, const std::string& rows) {
  if (fit.split.held_out_rows == 0) return "errors unknown";
  const auto text = [](const std::string& name, const ErrorFigures& figures) {
    return name + " rms " + error_text(figures.rms) + " max " + error_text(figures.max);
  };
  return "on " + std::to_string(fit.split.held_out_rows) + " rows " + rows + ": " +
         text("alpha", fit.alpha_error) + ", " + text(fit.target.specular, fit.specular_error);
}

Json candidate_json(const CandidateRecord& candidate) {
  return {{"name", candidate.name},
          {"numbers", candidate.number_count},
          {"alpha_error", figures_json(candidate.alpha)},
          {"relative_alpha", candidate.relative_alpha},
          {"specular_error", figures_json(candidate.specular)},
          {"relative_specular", candidate.relative_specular},
          {"rmse_percent", candidate.pictures ? Json(candidate.pictures->rmse) : Json()},
          {"one_light", candidate.pictures ? Json(candidate.pictures->relative) : Json()},
          {"verdict", candidate.verdict}};
}

}  // namespace remap
