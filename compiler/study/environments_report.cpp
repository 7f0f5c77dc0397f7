#include "study/environments_report.hpp"

#include <array>
#include <cmath>
#include <sstream>

#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "remap/version.hpp"
#include "report/gnuplot.hpp"
#include "report/sheet_labels.hpp"
#include "table/csv.hpp"

namespace remap {
namespace {

constexpr std::array kMethods = {Method::kCopy,     Method::kPaper,   Method::kNatural1,
                                 Method::kNatural2, Method::kShipped, Method::kBest};
constexpr double kRmseStep = 0.01, kSsimStep = 0.001;  // last digits of the figures in the text

std::string figures_text(const PictureSimilarity& image_similarity) {
  return fixed(image_similarity.rmse, 2, 8) + fixed(image_similarity.ssim, 3, 8) +
         fixed(100.0 * image_similarity.energy, 1, 8);
}

// All environments have the same mean luminance, up to rounding of their floats.
std::string brightness_text(const EnvironmentsOptions& options) {
  return number_text(std::round(1e6 * mean_luminance(options.environments.front())) / 1e6);
}

// The settings that the figures depend on.
Comments comments_of(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  return {{"tool", std::string("remap-study ") + kVersion},
          {"resolution", std::to_string(options.resolution)},
          {"samples", std::to_string(options.samples)},
          {"diffuse", number_text(options.diffuse)},
          {"mean_luminance", brightness_text(options)},
          {"noise_percent", number_text(rounded_up(result.noise, 2))}};
}

NamedFigures named(const PictureSimilarity& similarity) {
  return {{"rmse_percent", similarity.rmse}, {"ssim", similarity.ssim}, {"energy_error", similarity.energy}};
}

// The methods that have comparisons, in the order of Method.
std::vector<Method> methods_of(const EnvironmentsResult& result) {
  std::vector<Method> methods;
  for (const Method method : kMethods)
    if (!comparisons_of(result, method).empty()) methods.push_back(method);
  return methods;
}

// A pair for which a method is worse than copying.
struct WorsePair {
  Method method = Method::kPaper;
  std::size_t pair = 0;
  PictureSimilarity image_similarity, copy;
};

std::vector<WorsePair> worse_than_copy(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  std::vector<WorsePair> worse;
  for (const Method method : kMethods)
    for (std::size_t p = 0; p < options.pairs.size(); ++p) {
      const auto chosen = comparisons_of(result, method, p);
      if (chosen.empty()) continue;
      const PictureSimilarity mean = mean_similarity(chosen);
      const PictureSimilarity copy = mean_similarity(comparisons_of(result, Method::kCopy, p));
      if (mean.rmse > copy.rmse + 0.5 * kRmseStep || mean.ssim < copy.ssim - 0.5 * kSsimStep)
        worse.push_back({method, p, mean, copy});
    }
  return worse;
}

std::vector<const EnvironmentComparison*> at_alpha(
    const std::vector<const EnvironmentComparison*>& comparisons, double alpha) {
  std::vector<const EnvironmentComparison*> chosen;
  for (const EnvironmentComparison* comparison : comparisons)
    if (comparison->conversion.alpha == alpha) chosen.push_back(comparison);
  return chosen;
}

std::size_t pair_count(const EnvironmentsOptions& options, const EnvironmentsResult& result, Method method) {
  std::size_t count = 0;
  for (std::size_t p = 0; p < options.pairs.size(); ++p)
    count += comparisons_of(result, method, p).empty() ? 0 : 1;
  return count;
}

std::string counted_pairs(const EnvironmentsOptions& options, const EnvironmentsResult& result,
                          Method method) {
  const std::size_t count = pair_count(options, result, method);
  if (count == options.pairs.size()) return "";
  return " (" + std::to_string(count) + " of " + std::to_string(options.pairs.size()) + " pairs)";
}

std::string heading(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  return "Spheres under " + environment_names(options.environments) + ", mean luminance " +
         brightness_text(options) + "; alpha " + listed(options.alphas) + ", specular " +
         number_text(options.specular) + ", " + std::to_string(options.resolution) + " x " +
         std::to_string(options.resolution) + " pixels, sampling noise " +
         number_text(rounded_up(result.noise, 2)) +
         " %\nRMSE: % of the display range; SSIM: of luma; energy: error of the mean radiance in %\n";
}

std::string verdict_text(const EnvironmentsOptions& options, const EnvironmentsResult& result,
                         Method method) {
  std::string text;
  for (const WorsePair& worse : worse_than_copy(options, result)) {
    if (worse.method != method) continue;
    text += (text.empty() ? "" : ", ") + pair_name(options.pairs[worse.pair]) + " (RMSE" +
            fixed(worse.image_similarity.rmse, 2, 5) + " against" + fixed(worse.copy.rmse, 2, 5) + ", SSIM" +
            fixed(worse.image_similarity.ssim, 3, 6) + " against" + fixed(worse.copy.ssim, 3, 6) + ")";
  }
  return "With `" + method_name(method) + "`, " +
         (text.empty() ? "no pair is worse than copying" : "these pairs are worse than copying: " + text) +
         ".\n";
}

std::string comparisons_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  CsvText csv("source,target,alpha,specular,environment,method,target_alpha,target_specular," +
                  named(PictureSimilarity{}).header(),
              comments_of(options, result));
  for (const EnvironmentComparison& comparison : result.comparisons) {
    const Conversion& c = comparison.conversion;
    csv.add_row(options.pairs[c.pair].source, options.pairs[c.pair].target, c.alpha, options.specular,
                options.environments[comparison.environment].name, method_name(c.method), c.target_alpha,
                c.target_specular, named(comparison.image_similarity).values());
  }
  return csv.text();
}

std::string summary_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  CsvText csv("source,target,method," + named(PictureSimilarity{}).header(), comments_of(options, result));
  const auto add = [&](const StudyPair& models, Method method, std::size_t pair) {
    if (const auto chosen = comparisons_of(result, method, pair); !chosen.empty())
      csv.add_row(models.source, models.target, method_name(method), named(mean_similarity(chosen)).values());
  };
  for (const Method method : kMethods) add({"all", "all"}, method, kAllPairs);
  for (std::size_t p = 0; p < options.pairs.size(); ++p)
    for (const Method method : kMethods) add(options.pairs[p], method, p);
  return csv.text();
}

std::string summary_text(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  std::size_t width = 0;
  for (const StudyPair& pair : options.pairs) width = std::max(width, pair_name(pair).size() + 12);
  std::string text = heading(options, result) + padded("", width) + "    RMSE    SSIM  energy\n";
  for (const Method method : methods_of(result))
    text += padded(method_name(method) + counted_pairs(options, result, method), width) +
            figures_text(mean_similarity(comparisons_of(result, method))) + "\n";
  for (std::size_t p = 0; p < options.pairs.size(); ++p)
    for (const Method method : methods_of(result)) {
      const auto chosen = comparisons_of(result, method, p);
      if (!chosen.empty())
        text += padded(pair_name(options.pairs[p]) + "  " + method_name(method), width) +
                figures_text(mean_similarity(chosen)) + "\n";
    }
  for (const Method method : methods_of(result))
    if (method != Method::kCopy) text += verdict_text(options, result, method);
  for (const std::string& remark : result.remarks) text += remark + ".\n";
  return text;
}

std::string plot_script(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  // In the order of Method.
  static constexpr std::array<const char*, kMethods.size()> kColors = {
      "black", kPlotColors[1], "#c0c0c0", kPlotColors[0], kPlotColors[2], "#999999"};
  std::ostringstream out;
  std::array<std::string, 2> curves;
  for (const Method method : methods_of(result)) {
    const std::string name = method_name(method);
    if (pair_count(options, result, method) != options.pairs.size())
      continue;  // means over different pairs cannot be compared
    const std::string block = "$method" + std::to_string(static_cast<int>(method));
    out << block << " << EOD\n";
    for (const double alpha : options.alphas) {
      const PictureSimilarity mean = mean_similarity(at_alpha(comparisons_of(result, method), alpha));
      out << number_text(alpha) << ' ' << number_text(mean.rmse) << ' ' << number_text(mean.ssim) << '\n';
    }
    out << "EOD\n";
    for (std::size_t panel = 0; panel < curves.size(); ++panel)
      curves[panel] += (curves[panel].empty() ? "plot " : ", ") + block +
                       " using 1:" + std::to_string(panel + 2) +
                       " with linespoints linewidth 2 pointtype 7 pointsize 0.5 " + "linecolor rgb '" +
                       kColors[static_cast<std::size_t>(method)] + "' title " + gnuplot_text(name);
  }
  out << plot_style(1200, 480)
      << "set multiplot layout 1,2 margins 0.07,0.98,0.13,0.85 spacing 0.09,0.1 title 'Spheres under "
      << options.environments.size() << " environments, mean of " << options.pairs.size()
      << " pairs of models' font ',16'\n"
      << "set xlabel 'alpha of the source'\n"
      << "set title 'RMSE, % of the display range (lower is better)'\nset yrange [0:*]\nset key bottom "
         "left\n"
      << curves[0] << "\nset title 'SSIM of luma (1: equal)'\nset yrange [*:1]\nset key bottom right\n"
      << curves[1] << "\nunset multiplot\n";
  return out.str();
}

Json report_json(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  Json json = {{"noise_percent", result.noise}, {"methods", Json::object()}};
  for (const Method method : methods_of(result)) {
    Json& entry = json["methods"][method_name(method)];
    entry = named(mean_similarity(comparisons_of(result, method))).json();
    entry["pairs"] = Json::list();
    for (std::size_t p = 0; p < options.pairs.size(); ++p) {
      const auto chosen = comparisons_of(result, method, p);
      if (chosen.empty()) continue;
      Json pair = {{"source", options.pairs[p].source}, {"target", options.pairs[p].target}};
      pair.update(named(mean_similarity(chosen)).json());
      entry["pairs"].push_back(std::move(pair));
    }
  }
  json["worse_than_copy"] = Json::list();
  for (const WorsePair& worse : worse_than_copy(options, result))
    json["worse_than_copy"].push_back({{"method", method_name(worse.method)},
                                       {"source", options.pairs[worse.pair].source},
                                       {"target", options.pairs[worse.pair].target}});
  json["remarks"] = result.remarks;
  return json;
}

}  // namespace

StudyReport environments_report(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  StudyReport report{summary_text(options, result),
                     report_json(options, result),
                     {{"environments.csv", comparisons_csv(options, result)},
                      {"environments_summary.csv", summary_csv(options, result)}},
                     {{"environments.svg", plot_script(options, result)}},
                     {}};
  SheetLabels labels{{"source"}, {}};
  for (const Method method : kMethods)
    if (method != Method::kBest || options.least_error) labels.columns.push_back(method_name(method));
  for (const StudyPair& pair : options.pairs) labels.rows.push_back(pair.source + "\n-> " + pair.target);
  for (std::size_t e = 0; e < result.sheets.size(); ++e)
    report.sheets.emplace_back("spheres_" + options.environments[e].name + ".png",
                               labelled(result.sheets[e], labels));
  return report;
}

}  // namespace remap
