#include "manifest/report.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "fit/rows/split.hpp"
#include "model/round_trip.hpp"
#include "text/number_text.hpp"
#include "text/report_text.hpp"

namespace remapc {
namespace {

using remap::Fit;

std::string percent(double value) { return fixed(100.0 * value, value < 0.00995 ? 2 : 1); }

std::string range_text(const remap::Range& range) {
  return fixed(range.min, 3) + " to " + fixed(range.max, 3);
}

bool is_chain(const Fit& fit) { return std::holds_alternative<remap::Chain>(fit.mapping); }

double mean_ssim(const Fit& fit) {
  double sum = 0.0;
  for (const remap::SphereSimilarity& sphere : fit.image_similarity->ssim) sum += sphere.ssim;
  return sum / static_cast<double>(fit.image_similarity->ssim.size());
}

// Measured pairs by source and target.
using Pairs = std::map<std::pair<std::string, std::string>, const Fit*>;

Pairs measured_pairs(const std::vector<Fit>& fits) {
  Pairs pairs;
  for (const Fit& fit : fits)
    if (is_measured(fit)) pairs[{fit.source.model, fit.target.model}] = &fit;
  return pairs;
}

std::string alike_text(const Fit& fit) {
  return percent(fit.image_similarity->image_error.rms) + " %, " + fixed(mean_ssim(fit), 3);
}

std::string matrix(const Pairs& pairs, const std::set<std::string>& models) {
  std::string text = "| from \\ to |", rule = "|---|";
  for (const std::string& target : models) {
    text += " " + target + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const std::string& source : models) {
    text += "| **" + source + "** |";
    for (const std::string& target : models) {
      const auto found = pairs.find({source, target});
      text += found == pairs.end() ? " |" : " " + alike_text(*found->second) + " |";
    }
    text += "\n";
  }
  return text;
}

// Models that have a converter to and from one of the `hub` only.
std::string spokes(const Pairs& pairs, const std::set<std::string>& hub) {
  std::string text = "| model | of the hub | to it | from it |\n|---|---|---|---|\n";
  for (const auto& [pair, fit] : pairs) {
    if (hub.contains(pair.first)) continue;
    const auto back = pairs.find({pair.second, pair.first});
    text += "| **" + pair.first + "** | " + pair.second + " | " + alike_text(*fit) + " | " +
            (back == pairs.end() ? "" : alike_text(*back->second)) + " |\n";
  }
  return text;
}

std::string trip_text(const Fit& fit, const Pairs& pairs) {
  const auto back = pairs.find({fit.target.model, fit.source.model});
  if (back == pairs.end()) return "-";
  const remap::RoundTrip trip = remap::round_trip(fit, *back->second);
  if (trip.share == 0.0) return "domains do not meet";
  return percent(std::max(trip.alpha_median, trip.specular_median)) + ", " +
         percent(std::max(trip.alpha_p99, trip.specular_p99)) + (remap::returns(trip) ? "" : " (!)");
}

std::string bound_text(const Fit& fit, const Lock& lock) {
  const auto found = lock.items.find(fit.id);
  if (found == lock.items.end()) return "-";
  return error_text(found->second.alpha_bound) + ", " + error_text(found->second.specular_bound);
}

std::string fit_text(const Fit& fit) {
  return fit.has_errors() ? error_text(fit.roughness_error.rms) + ", " + error_text(fit.specular_error.rms)
                          : "unknown";
}

std::string pair_lines(const Pairs& pairs, const Lock& lock) {
  std::string text =
      "| converter | covers alpha | covers specular | image error rms, 99 % | SSIM mean, least | fit error | "
      "lowered within | there and back median, 99 % | kind |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& [pair, fit] : pairs) {
    const auto least = std::min_element(
        fit->image_similarity->ssim.begin(), fit->image_similarity->ssim.end(),
        [](const remap::SphereSimilarity& a, const remap::SphereSimilarity& b) { return a.ssim < b.ssim; });
    text += "| [" + fit->id + "](" + fit->id + ".json) | " + range_text(fit->domain.alpha) + " | to " +
            fixed(fit->domain.specular.max, 3) + " | " + percent(fit->image_similarity->image_error.rms) +
            " %, " + percent(fit->image_similarity->image_error.p99) + " % | " + fixed(mean_ssim(*fit), 3) +
            ", " + fixed(least->ssim, 3) + " at " + fixed(least->alpha, 2) + " | " + fit_text(*fit) + " | " +
            bound_text(*fit, lock) + " | " + trip_text(*fit, pairs) + " | " + kind_name(fit->mapping) +
            " |\n";
  }
  return text;
}

std::string other_lines(const std::vector<Fit>& fits, const Lock& lock) {
  std::string text =
      "| converter | covers alpha | covers specular | fit error | lowered within | where it comes from |\n"
      "|---|---|---|---|---|---|\n";
  for (const Fit& fit : fits) {
    if (is_measured(fit)) continue;
    std::string remarks;
    for (const std::string& remark : fit.remarks) remarks += (remarks.empty() ? "" : " ") + remark;
    if (const auto inverse = fit.table.comments.find("inverse_of"); inverse != fit.table.comments.end())
      remarks += "The way back through " + inverse->second + ".";
    if (is_chain(fit))
      remarks += " Against its steps: " + fit.method.at("against its steps one after another") + ".";
    text += "| [" + fit.id + "](" + fit.id + ".json) | " + range_text(fit.domain.alpha) + " | to " +
            fixed(fit.domain.specular.max, 3) + " | " + fit_text(fit) + " | " + bound_text(fit, lock) +
            " | " + remarks + " |\n";
  }
  return text;
}

constexpr const char* kIntroduction = R"(# Converters and how far to trust them

Written by `remapc build`. `remapc show ID` has the whole card of one.

Three things are apart, and a converter is as good as the worst of them:

1. **How alike the two models can be at all**: no converter can be better. *Image error* is the difference between the
   pictures of source and target at the best parameters, relative to the source's and weighted as the match weighs it,
   over the rows of the table. *SSIM* is that of the two spheres under the light of the match, as a screen shows them.
2. **How well the fit follows the measured table**: root mean square on rows that it was not trained on, in the target's
   alpha and specular.
3. **How well the polynomials of the header follow the fit**: proven bounds, in the target's alpha and specular.

*There and back* converts to the target and back by the converter of the other direction: the larger of the relative
changes of alpha and specular. Where the models differ in shape each direction finds its own best match, and what comes
back is not what went: such pairs carry (!), and their SSIM says why.

*Covers* is the domain: beyond it alpha is held at the edge and specular extrapolated in proportion, and the texel counts
as out of domain. A domain ends where the target's own parameter would leave its range.
)";

constexpr const char* kWorkflowIntroduction = R"(
## Between workflows

Whole materials in closed form (kind `analytic`) or by a network (`mlp`): diffuse and specular color to base color and metallic, and back. Their
headers take all rows of a material. Metallic says less than specular: what is lost is the residual of each texel, not of
the converter.

)";

std::string workflow_lines(const std::vector<remap::WorkflowFit>& fits) {
  std::string text =
      "| converter | F0 of a dielectric | diffuse | width | formula | remarks |\n|---|---|---|---|---|---|\n";
  for (const remap::WorkflowFit& fit : fits) {
    const remap::WorkflowConversion& conversion = fit.conversion;
    std::string remarks;
    for (const std::string& remark : fit.remarks) remarks += (remarks.empty() ? "" : " ") + remark;
    const std::string from = source_parameters(conversion).back().name,
                      to = target_parameters(conversion).back().name;
    text += "| [" + fit.id + "](" + fit.id + ".json) | " +
            remap::number_text(conversion.metallic.dielectric_f0) + " | " +
            std::string(diffuse_convention_name(conversion.specular.diffuse)) + " | " +
            (from == to ? from : from + " to " + to) + " | " + formula_text(conversion.formula) + " | " +
            remarks + " |\n";
  }
  return text;
}

constexpr const char* kWarpIntroduction = R"(
## Appearance of templates

Warps (`remapc warp`): the reflectance of one texture set for the pattern of another. *From an exact copy* is the RMS
distance from copied texels of the template, in shares of its spread.

)";

std::string warp_lines(const std::vector<remap::WarpMapFit>& fits) {
  std::string text =
      "| converter | from | to | dimensions | bytes | from an exact copy |\n|---|---|---|---|---|---|\n";
  for (const remap::WarpMapFit& fit : fits)
    text += "| [" + fit.id + "](" + fit.id + ".json) | " + fit.source_model + " | " + fit.template_model +
            " | " + std::to_string(fit.warp.coordinates.dimension) + " | " +
            std::to_string(byte_count(fit.warp)) + " | " +
            (fit.copy_rms_error < 0.0 ? "unknown" : percent(fit.copy_rms_error) + " %") + " |\n";
  return text;
}

}  // namespace

bool is_measured(const Fit& fit) { return fit.image_similarity && !fit.image_similarity->ssim.empty(); }

std::set<std::string> hub_models(const std::vector<Fit>& fits) {
  std::map<std::string, std::set<std::string>> neighbours;
  for (const Fit& fit : fits) {
    if (!is_measured(fit)) continue;
    neighbours[fit.source.model].insert(fit.target.model);
    neighbours[fit.target.model].insert(fit.source.model);
  }
  std::set<std::string> models;
  for (const auto& [model, others] : neighbours)
    if (others.size() > 1 || neighbours.at(*others.begin()).size() == 1) models.insert(model);
  return models;
}

std::vector<ReportFile> report(const FitFolder& folder, const Lock& lock) {
  const std::vector<Fit>& fits = folder.fits;
  const Pairs pairs = measured_pairs(fits);
  std::string text = kIntroduction;
  const std::set<std::string> hub = hub_models(fits);
  text += "\n## Every pair of the hub: image error rms, mean SSIM\n\n" + matrix(pairs, hub);
  text += "\n## Models of real renderers: image error rms, mean SSIM\n\n" + spokes(pairs, hub);
  text +=
      std::string("\n![Target alpha and specular over source alpha, a panel a pair](") + kPlotName + ")\n";
  text +=
      "\nBlue: target alpha over source alpha, both 0 to 1. Orange: target specular / source specular, 0 to "
      "2, over "
      "source alpha. Grey: the identity.\n";
  text += "\n## Measured pairs\n\n" + pair_lines(pairs, lock);
  text += "\n## Published formulas, inverses and chains\n\n" + other_lines(fits, lock);
  if (!folder.analytic.empty()) text += kWorkflowIntroduction + workflow_lines(folder.analytic);
  if (!folder.warps.empty()) text += kWarpIntroduction + warp_lines(folder.warps);
  return {{kReportName, text}, {kPlotName, pairs_plot(fits)}};
}

}  // namespace remapc
