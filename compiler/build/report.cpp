#include "build/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/number_text.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

constexpr const char* kMark = " **(!)**";

// If a pair has a smaller image error in both directions, it is listed without its SSIM.
constexpr double kSmallError = 0.01;

constexpr const char* kFigures = R"(
*Image error*: the RMS difference between the pictures of the two models at the best parameters, as a share of the source's
picture. It is a property of the models, so no converter between them can do better. *SSIM*: the mean structural similarity
of their spheres as a display shows them (1: equal). Outside its domain (CSV: alpha and specular), a converter clamps alpha,
scales specular in proportion and counts the texels. *Excess*: how much nearer the target could come than the converter
brings it, at the worst of the materials that `remap-study reach` compared (CSV: which).
)";

constexpr const char* kWorkflowIntroduction = R"(
## Between workflows

Metallic cannot represent every specular material; what remains depends on the texel, and texremap reports it.

)";

constexpr const char* kWarpIntroduction = R"(
## Warps

The reflectance of one texture set for the pattern of another. *Error*: RMS distance from an exact copy of the template's
texels, as a share of their spread.

)";

std::string percent_text(double value) {
  if (value < 0.00005) return "< 0.01 %";
  return fixed(100.0 * value, value < 0.00995 ? 2 : 1) + " %";
}

std::string link(const std::string& text, const std::string& id) { return "[" + text + "](" + id + ".json)"; }

// Returns the compared converters between each pair of models, in both directions. Pairs are sorted by the
// image error of the better direction. The best pair comes first.
std::vector<std::vector<const Fit*>> compared_pairs(const std::vector<Fit>& fits) {
  std::vector<std::vector<const Fit*>> pairs;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  for (const Fit* fit : by_trust(fits)) {
    if (!fit->image_error) continue;
    const auto [place, is_new] =
        known.try_emplace(std::minmax(fit->source.model, fit->target.model), pairs.size());
    if (is_new) pairs.emplace_back();
    pairs[place->second].push_back(fit);
  }
  return pairs;
}

std::string converters_text(const std::vector<const Fit*>& fits, const ReachRecords& reach,
                            bool with_similarity) {
  std::string text;
  for (const Fit* fit : fits) {
    text += (text.empty() ? "" : ", ") + link(percent_text(image_error(*fit)), fit->id);
    if (with_similarity && is_measured(*fit)) text += ", " + fixed(*mean_ssim(*fit), 3);
    const auto record = reach.find(fit->id);
    if (with_similarity && record != reach.end()) text += ", " + percent_text(record->second.largest_excess);
    if (!trust_warning(*fit).empty()) text += kMark;
  }
  return text;
}

std::string pair_lines(const std::vector<Fit>& fits, const ReachRecords& reach) {
  std::string small, others;
  for (const std::vector<const Fit*>& pair : compared_pairs(fits)) {
    const auto& [first, second] = std::minmax(pair.front()->source.model, pair.front()->target.model);
    std::vector<const Fit*> there, back;
    for (const Fit* fit : pair) (fit->source.model == first ? there : back).push_back(fit);
    const std::string names = first + ", " + second;
    if (std::ranges::all_of(pair, [](const Fit* fit) { return image_error(*fit) < kSmallError; }))
      small += (small.empty() ? "" : "; ") + names + " (" + converters_text(there, reach, false) +
               (there.empty() || back.empty() ? "" : ", ") + converters_text(back, reach, false) + ")";
    else
      others += "| " + names + " | " + converters_text(there, reach, true) + " | " +
                converters_text(back, reach, true) + " |\n";
  }
  std::string text;
  if (!small.empty())
    text += "\n## Image error below " + percent(kSmallError) + " both ways\n\n" + small + ".\n";
  if (!others.empty())
    text +=
        "\n## Other pairs of models\n\n"
        "| A, B | A to B: image error, SSIM, excess | B to A: image error, SSIM, excess |\n|---|---|---|\n" +
        others;
  return text;
}

std::string uncompared_lines(const std::vector<Fit>& fits) {
  std::string text;
  for (const Fit& fit : fits)
    if (!fit.image_error)
      text += (text.empty() ? "" : "; ") + link(fit.source.model + " to " + fit.target.model, fit.id);
  return text.empty() ? "" : std::string("\n## Never compared") + kMark + "\n\n" + text + ".\n";
}

std::string mark_text(const FitFolder& folder) {
  const std::size_t all = folder.fits.size() + folder.workflows.size() + folder.warps.size();
  const auto marked =
      std::ranges::count_if(folder.fits, [](const Fit& fit) { return !trust_warning(fit).empty(); });
  return "\n**(!)** marks " + std::to_string(marked) + " of " + std::to_string(all) +
         " converters: an image error above " + percent(kLargestTrustedError) +
         ", or pictures that were never compared\n(published formulas, and what is derived from them). "
         "Compare "
         "pictures before you use one of them.\n";
}

// Returns the errors that are not in the table of pairs.
std::string small_errors_text(const std::vector<Fit>& fits) {
  double fit_error = 0.0, bound = 0.0;
  for (const Fit& fit : fits) {
    fit_error = std::max(fit_error, fit.alpha_error.rms);
    if (fit.converter) bound = std::max(bound, fit.converter->alpha_bound);
  }
  if (fit_error == 0.0) return "";
  return "The other errors are small: converters follow the measured target alpha to " +
         error_text(fit_error) + " (RMS, unseen rows) or better,\nand headers follow their fit to " +
         error_text(bound) + " in alpha (proven) or better.\n";
}

// Returns the measured fits that end before the whole range, with the ranges that they cover.
std::string ranges_text(const std::vector<Fit>& fits) {
  constexpr double kWhole = 0.985;  // some exponents end at alpha 0.99
  std::map<std::string, std::string> short_ones;
  for (const Fit& fit : fits)
    if (is_measured(fit) && (fit.domain.alpha.max < kWhole || fit.domain.specular.max < kWhole)) {
      std::string& ids = short_ones["alpha to " + number_text(rounded(fit.domain.alpha.max, 3)) +
                                    ", specular to " + number_text(rounded(fit.domain.specular.max, 3))];
      ids += (ids.empty() ? "" : ", ") + fit.id;
    }
  std::string text = "Measured converters cover alpha 0.01 to 1 and specular 0 to 1";
  for (const auto& [range, ids] : short_ones) text += "; " + ids + ": " + range;
  return text + ".\n";
}

std::string workflow_lines(const std::vector<WorkflowFit>& fits) {
  std::string text = "| converter | dielectric F0 | diffuse | roughness | formula |\n|---|---|---|---|---|\n";
  for (const WorkflowFit& fit : fits) {
    const WorkflowConversion& conversion = fit.conversion;
    const std::string from = source_parameters(conversion).back().name,
                      to = target_parameters(conversion).back().name;
    text += "| " + link(fit.id, fit.id) + " | " + number_text(conversion.metallic.dielectric_f0) + " | " +
            std::string(diffuse_convention_name(conversion.specular.diffuse)) + " | " +
            (from == to ? from : from + " to " + to) + " | " + formula_text(conversion.formula) + " |\n";
  }
  return text;
}

std::string warp_lines(const std::vector<WarpMapFit>& fits) {
  std::string text = "| converter | from | to | dimensions | bytes | error |\n|---|---|---|---|---|---|\n";
  for (const WarpMapFit& fit : fits)
    text += "| " + link(fit.id, fit.id) + " | " + fit.source_model + " | " + fit.template_model + " | " +
            std::to_string(fit.warp.coordinates.dimension) + " | " + std::to_string(byte_count(fit.warp)) +
            " | " + (fit.copy_rms_error < 0.0 ? "unknown" : percent_text(fit.copy_rms_error)) + " |\n";
  return text;
}

std::string page(const FitFolder& folder) {
  std::string text =
      std::string("# Converters: which to trust\n\nBest first. All figures of every converter: [") +
      kFiguresName + "](" + kFiguresName +
      "); the card of one: `remapc show ID`.\n`remapc build` writes this page.\n";
  text += mark_text(folder) + kFigures + small_errors_text(folder.fits);
  text += ranges_text(folder.fits) + pair_lines(folder.fits, folder.reach) + uncompared_lines(folder.fits);
  if (!folder.workflows.empty()) text += kWorkflowIntroduction + workflow_lines(folder.workflows);
  if (!folder.warps.empty()) text += kWarpIntroduction + warp_lines(folder.warps);
  return text;
}

}  // namespace

bool is_measured(const Fit& fit) { return mean_ssim(fit).has_value(); }

double image_error(const Fit& fit) {
  return fit.image_error ? fit.image_error->rms : std::numeric_limits<double>::infinity();
}

std::string trust_warning(const Fit& fit) {
  if (!fit.image_error) return "pictures never compared";
  return image_error(fit) > kLargestTrustedError ? "image error above " + fixed(kLargestTrustedError, 2) : "";
}

std::vector<const Fit*> by_trust(const std::vector<Fit>& fits) {
  std::vector<const Fit*> sorted;
  for (const Fit& fit : fits) sorted.push_back(&fit);
  std::ranges::sort(sorted, [](const Fit* a, const Fit* b) {
    return std::pair(image_error(*a), a->id) < std::pair(image_error(*b), b->id);
  });
  return sorted;
}

std::vector<EmittedFile> report(const FitFolder& folder) {
  return {{kReportName, page(folder)}, {kFiguresName, converters_csv(folder)}};
}

}  // namespace remap
