#include "study/warps_report.hpp"

#include <algorithm>
#include <sstream>

#include "remap/version.hpp"
#include "report/gnuplot.hpp"
#include "study/warp_sheets.hpp"
#include "table/csv.hpp"
#include "text/number_text.hpp"
#include "text/report_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

constexpr std::size_t kNameWidth = 18;

std::string size_text(const WarpsOptions& options) {
  return std::to_string(options.cases.front().width) + " x " + std::to_string(options.cases.front().height);
}

std::string set_names(const WarpsOptions& options) {
  std::string names;
  for (const WarpCase& studied : options.cases) names += (names.empty() ? "" : ", ") + studied.name;
  return names;
}

std::string variant_title(const WarpVariant& variant) {
  switch (variant.group) {
    case WarpGroup::kDimensions:
      return variant.name + (variant.dimensions == 1 ? " dimension" : " dimensions");
    case WarpGroup::kPoints:
      return variant.name + " points";
    case WarpGroup::kNodes:
      return "nodes x " + variant.name;
    case WarpGroup::kMethod:
      break;
  }
  return variant.name;
}

std::string line_of(const WarpsOptions& options, const WarpsResult& result, std::size_t variant) {
  const WarpSummary summary = summary_of(result, variant);
  const WarpFigures& figures = summary.figures;
  std::string text = padded(variant_title(result.variants[variant]), kNameWidth) + fixed(figures.mean, 1, 7) +
                     fixed(figures.rms, 1, 7) + fixed(figures.median, 1, 8) + fixed(figures.p95, 1, 7) +
                     fixed(figures.strokes, 1, 9) + fixed(figures.used, 1, 7) + fixed(figures.tears, 2, 7);
  const std::string none = padded_left("-", 7);
  text += summary.cost ? fixed(summary.cost->folds, 2, 7) : none;
  text += fixed(figures.variation, 2, 11);
  text += summary.change ? fixed(*summary.change, 1, 8) : " " + none;
  if (summary.cost)
    text += fixed(summary.cost->compiled.mean, 1, 10) + fixed(summary.cost->compiled.difference, 2, 7) +
            fixed(summary.cost->bytes / 1000.0, 0, 6) +
            (summary.cost->seconds > 0.0 ? fixed(1000.0 * summary.cost->seconds, 0, 6) : padded_left("-", 6));
  else
    text += std::string(29, ' ');
  for (std::size_t set = 0; set < options.cases.size(); ++set)
    text += fixed(summary_of(result, variant, set).figures.mean, 1, 8);
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

// The cells of a cost; empty without a warp.
std::vector<std::optional<double>> cells_of(const std::optional<WarpCost>& cost) {
  if (!cost) return std::vector<std::optional<double>>(6);
  const std::optional<double> seconds = cost->seconds > 0.0 ? std::optional(cost->seconds) : std::nullopt;
  return {cost->folds, cost->compiled.mean, cost->compiled.difference, cost->bytes,
          seconds,     cost->dimensions};
}

NamedFigures named(const WarpFigures& figures) {
  return {{"error", figures.mean},      {"rms", figures.rms},
          {"median", figures.median},   {"p95", figures.p95},
          {"strokes", figures.strokes}, {"used", figures.used},
          {"tears", figures.tears},     {"variation", figures.variation}};
}

Comments comments_of(const WarpsOptions& options) {
  return {{"tool", std::string("remap-study ") + remap::kVersion},
          {"size", size_text(options)},
          {"sets", set_names(options)},
          {"unit", "percent of the template's spread unless stated otherwise"}};
}

// Writes the mean error of each set, one line for each variant.
void write_bars(const WarpsOptions& options, const WarpsResult& result, std::ostringstream& out) {
  out << "$bars << EOD\n";
  for (std::size_t v = 0; v < result.variants.size(); ++v) {
    const WarpVariant& variant = result.variants[v];
    if (variant.group != WarpGroup::kMethod && variant.group != WarpGroup::kDimensions) continue;
    out << '"' << variant_title(variant) << '"';
    for (std::size_t set = 0; set < options.cases.size(); ++set)
      out << ' ' << number_text(summary_of(result, v, set).figures.mean);
    out << '\n';
  }
  out << "EOD\n";
}

// Writes `x` and one value for each set, one line for each variant of the group.
template <typename Abscissa, typename Value>
void write_curves(const WarpsOptions& options, const WarpsResult& result, WarpGroup group, const char* name,
                  const Abscissa& x, const Value& value, std::ostringstream& out) {
  out << "$" << name << " << EOD\n";
  for (std::size_t v = 0; v < result.variants.size(); ++v) {
    if (result.variants[v].group != group) continue;
    out << number_text(x(result.variants[v]));
    for (std::size_t set = 0; set < options.cases.size(); ++set)
      out << ' ' << number_text(value(summary_of(result, v, set)));
    out << '\n';
  }
  out << "EOD\n";
}

std::string plots_of(const WarpsOptions& options, const char* data, const char* first, const char* style) {
  std::string text = "plot ";
  for (std::size_t set = 0; set < options.cases.size(); ++set)
    text += (set == 0 ? "" : ", ") + std::string("$") + data + " using " + first + std::to_string(2 + set) +
            (std::string(first).empty() ? ":xtic(1) " : " ") + style + " linecolor rgb '" +
            kPlotColors[set % kPlotColors.size()] + "' title \"" + options.cases[set].name + "\"";
  return text + "\n";
}

std::string summary_text(const WarpsOptions& options, const WarpsResult& result) {
  const std::size_t stroke_sets = options.cases.front().strokes.size();
  std::string text =
      "Sets " + set_names(options) + ", " + size_text(options) + " texels, " + std::to_string(stroke_sets) +
      (stroke_sets == 1 ? " set" : " sets") +
      " of strokes each. Appearance distances are in % of the template's spread;\n"
      "two unrelated texels are 141 % apart (rms).\n"
      "  error, rms, median, p95  distance to the correct result; `truth` copies the nearest texel to it\n"
      "  strokes                  distance of results on source strokes to the template's stroke\n"
      "  used, tears, folds       %: of the template's bins; of neighbors whose results are 25 apart; of "
      "texels where the warp folds\n"
      "  variation                between adjacent texels, relative to the truth\n"
      "  change                   distance between the results of two sets of strokes\n"
      "  compiled, table, kB, ms  error of the converter; its distance to the exact copy; its size; "
      "processor time of the fit\n"
      "  last columns             error of each set\n\n";
  const std::string head =
      "  error    rms  median    p95  strokes   used  tears  folds  variation  change  "
      "compiled  table    kB    ms";
  std::string sets;
  for (const WarpCase& studied : options.cases) sets += padded_left(studied.name, 8);
  for (std::size_t v = 0; v < result.variants.size(); ++v) {
    const WarpGroup group = result.variants[v].group;
    if (v == 0 || group != result.variants[v - 1].group)
      text += (v == 0 ? "" : "\n") + padded(group_name(group), kNameWidth) + head + sets + "\n";
    text += line_of(options, result, v);
  }
  const auto error = [&](const char* name) {
    return fixed(summary_of(result, variant_named(result, WarpGroup::kMethod, name)).figures.mean, 1);
  };
  return text + "\nMean error: registration " + error("registration") + " %, paper " + error("paper") +
         " %, histogram " + error("histogram") + " %, nearest texel without a warp " + error("nearest") +
         " %.\n";
}

std::string rows_csv(const WarpsOptions& options, const WarpsResult& result) {
  CsvText csv("set,stroke_set,group,variant," + named(WarpFigures{}).header() +
                  ",folds,compiled_error,table_difference,bytes,seconds,dimensions",
              comments_of(options));
  for (const WarpRow& row : result.rows) {
    const WarpVariant& variant = result.variants[row.variant];
    csv.add_row(options.cases[row.set].name, row.stroke_set, group_name(variant.group), variant.name,
                named(row.figures).values(), cells_of(row.cost));
  }
  return csv.text();
}

std::string sensitivity_csv(const WarpsOptions& options, const WarpsResult& result) {
  CsvText csv("set,group,variant,first,second,change", comments_of(options));
  for (const StrokeChange& change : result.changes) {
    const WarpVariant& variant = result.variants[change.variant];
    csv.add_row(options.cases[change.set].name, group_name(variant.group), variant.name, change.first,
                change.second, change.change);
  }
  return csv.text();
}

remap::Json summary_json(const WarpSummary& summary) {
  remap::Json json = named(summary.figures).json();
  if (summary.change) json["change"] = *summary.change;
  if (!summary.cost) return json;
  json["folds"] = summary.cost->folds;
  json["compiled_error"] = summary.cost->compiled.mean;
  json["table_difference"] = summary.cost->compiled.difference;
  json["bytes"] = summary.cost->bytes;
  if (summary.cost->seconds > 0.0) json["seconds"] = summary.cost->seconds;
  return json;
}

remap::Json report_json(const WarpsOptions& options, const WarpsResult& result) {
  remap::Json json = {{"width", options.cases.front().width}, {"height", options.cases.front().height}};
  for (const WarpCase& studied : options.cases)
    json["sets"].push_back({{"name", studied.name}, {"stroke_sets", studied.strokes.size()}});
  for (std::size_t v = 0; v < result.variants.size(); ++v) {
    remap::Json& entry = json[group_name(result.variants[v].group)][result.variants[v].name];
    entry = summary_json(summary_of(result, v));
    for (std::size_t set = 0; set < options.cases.size(); ++set)
      entry["sets"][options.cases[set].name] = summary_json(summary_of(result, v, set));
  }
  return json;
}

std::string plot_script(const WarpsOptions& options, const WarpsResult& result) {
  std::ostringstream out;
  write_bars(options, result, out);
  write_curves(
      options, result, WarpGroup::kPoints, "points",
      [](const WarpVariant& variant) { return variant.points; },
      [](const WarpSummary& summary) { return summary.figures.mean; }, out);
  write_curves(
      options, result, WarpGroup::kNodes, "nodes", [](const WarpVariant& variant) { return variant.nodes; },
      [](const WarpSummary& summary) { return summary.cost->compiled.difference; }, out);
  out << plot_style(1500, 520) << "set grid noxtics\nset multiplot title 'Error of appearance warps, "
      << size_text(options) << " texels' font ',16'\n"
      << "set yrange [0:*]\n"
      << "set origin 0,0\nset size 0.5,0.94\nset style data histograms\nset style histogram clustered gap 1\n"
      << "set style fill solid border -1\nset xtics rotate by -30 scale 0\nset key top left noenhanced\n"
      << "set title 'Error, % of the template''s spread'\n"
      << plots_of(options, "bars", "", "")
      << "set origin 0.5,0\nset size 0.25,0.94\nset xtics norotate autofreq scale 1\nset logscale x\nset key "
         "off\n"
      << "set xtics (50, 150, 350, 1200)\nset xrange [40:1500]\nset title 'Error over points'\nset xlabel "
         "'points'\n"
      << plots_of(options, "points", "1:", "with linespoints pointtype 7")
      << "set origin 0.75,0\nset xtics ('1/8' 0.125, '1/4' 0.25, '1/2' 0.5, '1' 1, '2' 2)\nset xrange "
         "[0.1:2.5]\n"
      << "set title 'Compiled table against exact copy'\nset xlabel 'nodes, times the default'\n"
      << plots_of(options, "nodes", "1:", "with linespoints pointtype 7") << "unset multiplot\n";
  return out.str();
}

}  // namespace

StudyReport warps_report(const WarpsOptions& options, const WarpsResult& result) {
  StudyReport report{
      summary_text(options, result),
      report_json(options, result),
      {{"warp.csv", rows_csv(options, result)}, {"warp_sensitivity.csv", sensitivity_csv(options, result)}},
      "warp.svg",
      plot_script(options, result),
      {}};
  if (!options.pictures) return report;
  report.summary += "\n";
  for (WarpSheet& sheet : warp_sheets(options, result)) {
    report.summary += sheet.name + ".png: " + sheet.legend + ".\n";
    report.sheets.emplace_back(sheet.name + ".png", std::move(sheet.picture));
  }
  return report;
}

}  // namespace remapc
