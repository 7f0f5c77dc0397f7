#include "study/environments_report.hpp"

#include <array>
#include <cmath>
#include <sstream>

#include "remap/version.hpp"
#include "report/gnuplot.hpp"
#include "text/number_text.hpp"
#include "text/report_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

constexpr std::array kMethods = {Method::kCopy, Method::kPaper, Method::kNatural, Method::kShipped,
                                 Method::kBest};
constexpr double kRmseStep = 0.01, kSsimStep = 0.001;  // last digits of the figures in the text

std::string figures_text(const PictureSimilarity& image_similarity) {
  return fixed(image_similarity.rmse, 2, 8) + fixed(image_similarity.ssim, 3, 8) +
         fixed(100.0 * image_similarity.energy, 1, 8);
}

// All environments have the same mean luminance, up to rounding of their floats.
std::string brightness_text(const EnvironmentsOptions& options) {
  return number_text(std::round(1e6 * mean_luminance(options.environments.front())) / 1e6);
}

// Comment lines with the settings that the figures depend on.
std::string comments_of(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  return comment_lines({{"tool", std::string("remap-study ") + remap::kVersion},
                        {"resolution", std::to_string(options.resolution)},
                        {"samples", std::to_string(options.samples)},
                        {"mean_luminance", brightness_text(options)},
                        {"noise_percent", number_text(remap::rounded_up(result.noise, 2))}});
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
         number_text(remap::rounded_up(result.noise, 2)) +
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

}  // namespace

std::vector<Method> methods_of(const EnvironmentsResult& result) {
  std::vector<Method> methods;
  for (const Method method : kMethods)
    if (!comparisons_of(result, method).empty()) methods.push_back(method);
  return methods;
}

std::string comparisons_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  std::string text = comments_of(options, result) +
                     "source,target,alpha,specular,environment,method,target_alpha,target_specular,"
                     "rmse_percent,ssim,energy_error\n";
  for (const EnvironmentComparison& comparison : result.comparisons) {
    const Conversion& c = comparison.conversion;
    text += options.pairs[c.pair].source + "," + options.pairs[c.pair].target + "," + number_text(c.alpha) +
            "," + number_text(options.specular) + "," + options.environments[comparison.environment].name +
            "," + method_name(c.method) + "," + number_text(c.target_alpha) + "," +
            number_text(c.target_specular) + "," + number_text(comparison.image_similarity.rmse) + "," +
            number_text(comparison.image_similarity.ssim) + "," +
            number_text(comparison.image_similarity.energy) + "\n";
  }
  return text;
}

std::string summary_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  std::string text = comments_of(options, result) + "source,target,method,rmse_percent,ssim,energy_error\n";
  const auto add = [&](const std::string& models, Method method, std::size_t pair) {
    const auto chosen = comparisons_of(result, method, pair);
    if (chosen.empty()) return;
    const PictureSimilarity mean = mean_similarity(chosen);
    text += models + "," + method_name(method) + "," + number_text(mean.rmse) + "," + number_text(mean.ssim) +
            "," + number_text(mean.energy) + "\n";
  };
  for (const Method method : kMethods) add("all,all", method, kAllPairs);
  for (std::size_t p = 0; p < options.pairs.size(); ++p)
    for (const Method method : kMethods)
      add(options.pairs[p].source + "," + options.pairs[p].target, method, p);
  return text;
}

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

std::string summary_text(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  std::size_t width = 0;
  for (const ModelPair& pair : options.pairs) width = std::max(width, pair_name(pair).size() + 12);
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
      "black", kPlotColors[1], kPlotColors[0], kPlotColors[2], "#999999"};
  std::ostringstream out;
  std::array<std::string, 2> curves;
  for (const Method method : methods_of(result)) {
    const std::string name = method_name(method);
    if (pair_count(options, result, method) != options.pairs.size())
      continue;  // means over different pairs cannot be compared
    out << "$" << name << " << EOD\n";
    for (const double alpha : options.alphas) {
      const PictureSimilarity mean = mean_similarity(at_alpha(comparisons_of(result, method), alpha));
      out << number_text(alpha) << ' ' << number_text(mean.rmse) << ' ' << number_text(mean.ssim) << '\n';
    }
    out << "EOD\n";
    for (std::size_t panel = 0; panel < curves.size(); ++panel)
      curves[panel] += (curves[panel].empty() ? "plot $" : ", $") + name +
                       " using 1:" + std::to_string(panel + 2) +
                       " with linespoints linewidth 2 pointtype 7 pointsize 0.5 " + "linecolor rgb '" +
                       kColors[static_cast<std::size_t>(method)] + "' title '" + name + "'";
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

}  // namespace remapc
