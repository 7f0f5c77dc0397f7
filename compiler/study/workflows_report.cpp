#include "study/workflows_report.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "remap/version.hpp"
#include "report/gnuplot.hpp"
#include "report/sheet_labels.hpp"
#include "table/csv.hpp"

namespace remap {
namespace {

std::size_t name_width(const WorkflowsResult& result) {
  std::size_t width = 0;
  for (const WorkflowComparison& comparison : result.comparisons)
    for (const std::string& method : comparison.methods) width = std::max(width, method.size() + 2);
  return width;
}

// The groups that have materials, in the order of MaterialGroup.
std::vector<MaterialGroup> groups_of(const WorkflowsOptions& options) {
  std::vector<MaterialGroup> groups;
  for (std::size_t g = 0; g < kMaterialGroups; ++g)
    if (std::ranges::count(options.materials, static_cast<MaterialGroup>(g), &StudyMaterial::group) > 0)
      groups.push_back(static_cast<MaterialGroup>(g));
  return groups;
}

std::string comparison_text(const WorkflowsOptions& options, const WorkflowComparison& comparison,
                            std::size_t width) {
  std::string text = padded(comparison.convention == "gltf" ? "glTF diffuse" : "plain diffuse", width) +
                     "   RMSE    SSIM   worst   headlight        RMSE of";
  for (const MaterialGroup group : groups_of(options)) text += padded_left(group_name(group), 9);
  text += "\n";
  for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
    const WorkflowFigures all = figures_of(options, comparison, m);
    text += padded(comparison.methods[m], width) + fixed(all.rmse, 2, 7) + fixed(all.ssim, 4, 8) +
            fixed(all.worst_ssim, 3, 8) + fixed(all.headlight_rmse, 2, 7) + fixed(all.headlight_ssim, 4, 8) +
            std::string(9, ' ');
    for (const MaterialGroup group : groups_of(options))
      text += fixed(figures_of(options, comparison, m, group).rmse, 2, 9);
    text += "\n";
  }
  return text;
}

// States how far the error of the projection is above the least error.
std::string verdict(const WorkflowsOptions& options, const WorkflowComparison& comparison) {
  const auto found = std::find(comparison.methods.begin(), comparison.methods.end(), "projection");
  const auto place = static_cast<std::size_t>(found - comparison.methods.begin());
  const double own = figures_of(options, comparison, place).rmse;
  const double least = figures_of(options, comparison, comparison.methods.size() - 1).rmse;
  return "The RMSE of the projection is" + fixed(100.0 * (own / least - 1.0), 1, 4) +
         " % above the least that any base color and metallic reach under these environments.\n";
}

std::string family_text(const std::vector<FamilyLine>& family, std::size_t width) {
  std::string text = padded("round trip, rms", width);
  for (std::size_t kind = 0; kind < kFamilyKinds; ++kind)
    text += padded_left(family_name(static_cast<FamilyKind>(kind)), 20);
  text += "\n" + padded("", width);
  for (std::size_t kind = 0; kind < kFamilyKinds; ++kind) text += "   metallic    base";
  text += "\n";
  for (const FamilyLine& line : family) {
    text += padded(line.method, width);
    for (const FamilyErrors& errors : line.errors)
      text += fixed(errors.metallic, 4, 12) + fixed(errors.base_color, 4, 8);
    text += "\n";
  }
  return text;
}

Comments comments_of(const WorkflowsOptions& options) {
  return {{"tool", std::string("remap-study ") + kVersion},
          {"resolution", std::to_string(options.resolution)},
          {"samples", std::to_string(options.samples)},
          {"environments", environment_names(options.environments)},
          {"alphas", listed(options.alphas)}};
}

NamedFigures named(const WorkflowFigures& figures) {
  return {{"rmse_percent", figures.rmse},
          {"ssim", figures.ssim},
          {"worst_ssim", figures.worst_ssim},
          {"headlight_rmse_percent", figures.headlight_rmse},
          {"headlight_ssim", figures.headlight_ssim}};
}

double mean_of_environments(const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) sum += values[i];
  return sum / static_cast<double>(values.size() - 1);
}

std::string summary_text(const WorkflowsOptions& options, const WorkflowsResult& result,
                         const std::vector<FamilyLine>& family) {
  std::size_t width = name_width(result);
  for (const FamilyLine& line : family) width = std::max(width, line.method.size() + 2);
  std::string text =
      std::to_string(options.materials.size()) + " materials at alpha " + listed(options.alphas) + " under " +
      std::to_string(options.environments.size()) + " environments, " + std::to_string(options.resolution) +
      " x " + std::to_string(options.resolution) +
      " pixels\nRMSE: % of the display range; SSIM: of luma; worst: mean SSIM of the worst 5 %\n";
  for (const WorkflowComparison& comparison : result.comparisons)
    text += "\n" + comparison_text(options, comparison, width) + verdict(options, comparison);
  return text + "\n" + family_text(family, width);
}

std::string materials_csv(const WorkflowsOptions& options, const WorkflowsResult& result) {
  CsvText csv(
      "convention,material,group,alpha,diffuse_r,diffuse_g,diffuse_b,f0_r,f0_g,f0_b,method,"
      "base_color_r,base_color_g,base_color_b,metallic,rmse_percent,ssim,headlight_rmse_percent,"
      "headlight_ssim",
      comments_of(options));
  for (const WorkflowComparison& comparison : result.comparisons)
    for (std::size_t i = 0; i < options.materials.size(); ++i)
      for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
        const StudyMaterial& material = options.materials[i];
        const WorkflowPictures& pictures = comparison.pictures[m][i];
        csv.add_row(comparison.convention, material.name, group_name(material.group),
                    options.alphas[material.alpha], material.surface.diffuse, material.surface.f0,
                    comparison.methods[m], pictures.surface.base_color, pictures.surface.metallic,
                    mean_of_environments(pictures.rmse), mean_of_environments(pictures.ssim),
                    pictures.rmse.back(), pictures.ssim.back());
      }
  return csv.text();
}

std::string summary_csv(const WorkflowsOptions& options, const WorkflowsResult& result) {
  CsvText csv("convention,method,group," + named(WorkflowFigures{}).header(), comments_of(options));
  for (const WorkflowComparison& comparison : result.comparisons)
    for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
      const auto add = [&](const std::string& group, const WorkflowFigures& figures) {
        csv.add_row(comparison.convention, comparison.methods[m], group, named(figures).values());
      };
      add("all", figures_of(options, comparison, m));
      for (const MaterialGroup group : groups_of(options))
        add(group_name(group), figures_of(options, comparison, m, group));
    }
  return csv.text();
}

Json report_json(const WorkflowsOptions& options, const WorkflowsResult& result,
                 const std::vector<FamilyLine>& family) {
  Json json = {{"materials", options.materials.size()}};
  for (const WorkflowComparison& comparison : result.comparisons)
    for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
      Json& entry = json[comparison.convention][comparison.methods[m]];
      entry = named(figures_of(options, comparison, m)).json();
      for (const MaterialGroup group : groups_of(options))
        entry["groups"][group_name(group)] = named(figures_of(options, comparison, m, group)).json();
    }
  for (const FamilyLine& line : family)
    for (std::size_t kind = 0; kind < kFamilyKinds; ++kind)
      json["family"][line.method][family_name(static_cast<FamilyKind>(kind))] = {
          {"metallic_rms", line.errors[kind].metallic}, {"base_color_rms", line.errors[kind].base_color}};
  return json;
}

std::string sheet_text(const WorkflowsResult& result) {
  if (result.sheets.empty()) return "";
  std::string text = "\nRows of the contact sheets: ";
  for (std::size_t i = 0; i < result.sheet_materials.size(); ++i)
    text += (i == 0 ? "" : ", ") + result.sheet_materials[i];
  return text + ".\nColumns: the source material, then the methods of the first table.\n";
}

std::string plot_script(const WorkflowsOptions& options, const WorkflowsResult& result) {
  static constexpr std::array<const char*, 8> kColors = {"black",        "#999999",      kPlotColors[3],
                                                         kPlotColors[4], kPlotColors[1], kPlotColors[5],
                                                         kPlotColors[0], kPlotColors[2]};
  const WorkflowComparison& comparison = result.comparisons.front();
  std::ostringstream out;
  std::array<std::string, 2> bars;
  out << "$figures << EOD\n";
  const auto line = [&](const std::string& name, std::optional<MaterialGroup> group) {
    out << name;
    for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
      const WorkflowFigures figures = figures_of(options, comparison, m, group);
      out << ' ' << number_text(figures.rmse) << ' ' << number_text(1.0 - figures.ssim);
    }
    out << '\n';
  };
  line("all", {});
  for (const MaterialGroup group : groups_of(options)) line(group_name(group), group);
  out << "EOD\n";
  for (std::size_t m = 0; m < comparison.methods.size(); ++m)
    for (std::size_t panel = 0; panel < bars.size(); ++panel)
      bars[panel] += (bars[panel].empty() ? "plot " : ", ") + std::string("$figures using ") +
                     std::to_string(2 + 2 * m + panel) + ":xtic(1) linecolor rgb '" +
                     kColors[m % kColors.size()] + "' title " + gnuplot_text(comparison.methods[m]);
  out << plot_style(1400, 520)
      << "set grid noxtics\nset multiplot layout 1,2 margins 0.05,0.99,0.09,0.84 spacing 0.07,0.1 title "
         "'Specular to metallic, "
      << options.materials.size() << " materials under " << options.environments.size()
      << " environments' font ',16'\n"
      << "set style data histograms\nset style histogram clustered gap 1\nset style fill solid border -1\n"
      << "set yrange [0:*]\n"
      << "set title 'RMSE, % of the display range (lower is better)'\nset key off\n"
      << bars[0] << "\nset title '1 - SSIM of luma (0: equal)'\nset key top left reverse Left noenhanced\n"
      << bars[1] << "\nunset multiplot\n";
  return out.str();
}

}  // namespace

StudyReport workflows_report(const WorkflowsOptions& options, const WorkflowsResult& result,
                             const std::vector<FamilyLine>& family, const std::vector<std::string>& remarks) {
  StudyReport report{summary_text(options, result, family) + sheet_text(result),
                     report_json(options, result, family),
                     {{"workflows.csv", materials_csv(options, result)},
                      {"workflows_summary.csv", summary_csv(options, result)}},
                     {{"workflows.svg", plot_script(options, result)}},
                     {}};
  for (const std::string& remark : remarks) report.summary += "Note: " + remark + ".\n";
  report.figures["remarks"] = remarks;
  SheetLabels labels{{"source"}, result.sheet_materials};
  const std::vector<std::string>& methods = result.comparisons.front().methods;
  labels.columns.insert(labels.columns.end(), methods.begin(), methods.end());
  for (std::size_t e = 0; e < result.sheets.size(); ++e)
    report.sheets.emplace_back("workflows_" + options.environments[e].name + ".png",
                               labelled(result.sheets[e], labels));
  return report;
}

}  // namespace remap
