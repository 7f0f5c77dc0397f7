#include "study/reach_report.hpp"

#include <algorithm>

#include "core/number_text.hpp"
#include "core/report_text.hpp"

namespace remap {
namespace {

std::string excess_text(double share) { return fixed(100.0 * share, 3); }

std::string material_row(const std::string& id, const ReachedMaterial& m) {
  std::string row = id;
  for (const double value : {m.alpha, m.specular, m.target_alpha, m.target_specular, m.error, m.least_alpha,
                             m.least_specular, m.least_error})
    row += "," + number_text(rounded(value, 6));
  return row + "\n";
}

}  // namespace

StudyReport reach_report(const ReachOptions& options, const std::vector<FitReach>& result) {
  std::vector<const FitReach*> worst_first;
  for (const FitReach& reach : result) worst_first.push_back(&reach);
  std::ranges::sort(worst_first, std::greater<>(),
                    [](const FitReach* reach) { return reach->worst().excess(); });
  StudyReport report;
  report.summary =
      "excess of the image error over the least that the target can reach, % of the source: mean, largest "
      "(its alpha, specular)\n";
  std::string table =
      "fit,alpha,specular,target_alpha,target_specular,error,least_alpha,least_specular,least_error\n";
  double sum = 0.0;
  report.figures["fits"] = Json::list();
  for (const FitReach* reach : worst_first) {
    const std::string& id = options.fits[reach->fit].id;
    const ReachedMaterial& worst = reach->worst();
    sum += reach->mean_excess();
    report.summary += excess_text(reach->mean_excess()) + "  " + excess_text(worst.excess()) + "  (" +
                      number_text(rounded(worst.alpha, 3)) + ", " + number_text(rounded(worst.specular, 3)) +
                      ")  " + id + "\n";
    report.figures["fits"].push_back({{"id", id},
                                      {"mean_excess", reach->mean_excess()},
                                      {"largest_excess", worst.excess()},
                                      {"alpha", worst.alpha},
                                      {"specular", worst.specular}});
    for (const ReachedMaterial& material : reach->materials) table += material_row(id, material);
  }
  report.figures["mean_excess"] = sum / static_cast<double>(result.size());
  report.summary += "mean of all " + excess_text(sum / static_cast<double>(result.size())) + "\n";
  report.tables.emplace_back("reach.csv", table);
  return report;
}

}  // namespace remap
