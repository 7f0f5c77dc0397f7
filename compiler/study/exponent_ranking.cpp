#include "study/exponent_ranking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "remap/error.hpp"
#include "report/contact_sheet.hpp"
#include "report/sheet_labels.hpp"
#include "study/form_rule.hpp"
#include "study/lobe_bank.hpp"

namespace remap {
namespace {

std::size_t decade_of(const LobeMaterial& material) {
  const double exponent = from_alpha(RoughnessConvention::kExponent, material.alpha);
  return static_cast<std::size_t>(std::clamp(std::floor(std::log10(exponent) + 1e-9), 0.0, kDecades - 1.0));
}

void add_decades(const std::vector<LobeMaterial>& materials, const std::vector<RuleError>& errors,
                 RankedRule& rule) {
  std::array<double, kDecades> sums{}, counts{};
  std::array<std::vector<double>, kDecades> relative;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const std::size_t decade = decade_of(materials[m]);
    sums[decade] += errors[m].rmse;
    counts[decade] += 1.0;
    relative[decade].push_back(errors[m].relative);
  }
  for (std::size_t d = 0; d < kDecades; ++d) {
    rule.rmse[d] = sums[d] / counts[d];
    rule.relative[d] = median(relative[d]);
  }
}

// A base color is at most 1, and diffuse is base color times 1 - F (appendix B of glTF 2.0).
LobeRule in_gltf(const LobeRule& rule) {
  return [rule](const LobeMaterial& material) {
    LobeSurface surface = rule(material);
    const double left = 1.0 - *std::ranges::max_element(surface.specular);
    for (double& diffuse : surface.diffuse) diffuse = std::min(diffuse, left);
    return surface;
  };
}

std::vector<double> alphas_of(const std::vector<LobeMaterial>& materials) {
  std::vector<double> alphas;
  for (const LobeMaterial& material : materials) alphas.push_back(material.alpha);
  std::ranges::sort(alphas);
  alphas.erase(std::unique(alphas.begin(), alphas.end()), alphas.end());
  return alphas;
}

struct ShownMaterial {
  std::size_t index;  // of opengl_materials()
  const char* name;
};
constexpr std::array<ShownMaterial, 4> kShownMaterials = {
    {{10, "gold"}, {8, "chrome"}, {15, "red plastic"}, {19, "cyan rubber"}}};

}  // namespace

Image exponent_sheet(const Environment& environment, const SphereSampling& sampling, const ShortForm& form) {
  const StudyLights lights({environment}, sampling);
  const std::vector<LobeMaterial> all = opengl_materials();
  const std::vector<ExponentRule> rules = exponent_rules();
  std::vector<LobeMaterial> materials;
  std::vector<LobeSurface> surfaces;  // a row after the other
  SheetLabels labels{{"source"}, {}};
  for (const char* name : kShownRules) labels.columns.emplace_back(name);
  for (const ShownMaterial& shown : kShownMaterials) {
    materials.push_back(all[shown.index]);
    labels.rows.emplace_back(shown.name);
    for (const char* name : kShownRules)
      surfaces.push_back(
          rule_of(*std::ranges::find(rules, name, &ExponentRule::name), form)(materials.back()));
  }
  std::vector<double> widths;
  for (const LobeSurface& surface : surfaces) widths.push_back(surface.alpha);
  std::ranges::sort(widths);
  widths.erase(std::unique(widths.begin(), widths.end()), widths.end());
  const LobePictures source(lights, form.source, alphas_of(materials)), target(lights, form.target, widths);
  Image sheet = contact_sheet(kShownMaterials.size(), 1 + kShownRules.size(), lights.resolution());
  const auto place = [&](std::size_t row, std::size_t column, const LobePictures& lobes, double alpha,
                         const Rgb& specular, const Rgb& diffuse, bool is_constant) {
    std::vector<float> picture(3 * lights.pixels().size(), 0.0f);
    for (std::size_t i = 0; i < picture.size(); ++i)
      picture[i] = static_cast<float>(diffuse[i % 3]) * lights.diffuse(0)[i];
    lobes.add(0, alpha, specular, is_constant, picture);
    place_picture(&sheet, lights.resolution(), row, column, lights.pixels(), display_values(picture));
  };
  for (std::size_t row = 0; row < materials.size(); ++row) {
    place(row, 0, source, materials[row].alpha, materials[row].specular, materials[row].diffuse, false);
    for (std::size_t r = 0; r < kShownRules.size(); ++r) {
      const LobeSurface& surface = surfaces[row * kShownRules.size() + r];
      place(row, 1 + r, target, surface.alpha, surface.specular, surface.diffuse, surface.is_constant);
    }
  }
  return labelled(sheet, labels);
}

std::vector<LobeRanking> rank_exponent_rules(const ShortFormsOptions& options,
                                             const std::vector<ShortForm>& forms) {
  LobeBank bank(options.judging, options);
  std::vector<LobeRanking> rankings;
  for (const ShortForm& form : forms) {
    if (form.kind != ShortKind::kExponent && form.kind != ShortKind::kExponentNormal) continue;
    if (options.cancelled != nullptr && *options.cancelled)
      throw Error(ErrorKind::kInterrupted, "study: interrupted; nothing was written");
    const LobePictures& target = bank.of(form.target);
    const RuleJudge judge(bank.lights(), bank.of(form.source), target,
                          exponent_materials(form.source, Half::kJudging));
    const bool is_opengl = form.source == "legacy/blinn-phong";
    const std::vector<LobeMaterial> shown = opengl_materials();
    const LobePictures lobes(bank.lights(), form.source, alphas_of(shown));
    const RuleJudge courses(bank.lights(), lobes, target, shown);

    LobeRanking ranking{form.source, {}};
    const auto add = [&](const char* name, const std::string& formula, const LobeRule& rule,
                         Judged (RuleJudge::*judged_by)(const LobeRule&) const) {
      const Judged judged = (judge.*judged_by)(rule);
      RankedRule ranked{name, formula, judged.figures, {}, {}, std::numeric_limits<double>::quiet_NaN()};
      add_decades(judge.materials(), judged.errors, ranked);
      if (is_opengl) ranked.opengl = (courses.*judged_by)(rule).figures.rmse;
      ranking.rules.push_back(std::move(ranked));
    };
    const Fit* fit = fit_of(options.fits, form);
    const LobeRule compiled = fit == nullptr ? nullptr : compiled_rule(*fit, form);
    add("best possible", "any alpha and strength, diffuse of the form", FormRule(form), &RuleJudge::by_least);
    if (compiled) add("best possible, Kd kept", "any alpha and strength", compiled, &RuleJudge::by_least);
    const auto first_rule = static_cast<std::ptrdiff_t>(ranking.rules.size());
    for (const ExponentRule& rule : exponent_rules())
      add(rule.name.c_str(), rule.formula, rule_of(rule, form), &RuleJudge::by_rule);
    if (compiled) {
      add("converter", "the compiled one, Kd kept", compiled, &RuleJudge::by_rule);
      add("converter, glTF", "the same, diffuse at most 1 - F", in_gltf(compiled), &RuleJudge::by_rule);
    }
    std::stable_sort(ranking.rules.begin() + first_rule, ranking.rules.end(),
                     [](const RankedRule& a, const RankedRule& b) { return a.all.rmse < b.all.rmse; });
    rankings.push_back(std::move(ranking));
  }
  return rankings;
}

}  // namespace remap
