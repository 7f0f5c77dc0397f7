#include "study/short_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/number_text.hpp"
#include "remap/error.hpp"
#include "study/form_rule.hpp"
#include "study/lobe_bank.hpp"
#include "study/rule_judge.hpp"
#include "study/simplex.hpp"

namespace remap {
namespace {

// Errors are compared with the least that is possible. These keep pictures that are nearly equal from
// deciding: RMSE in percent, and relative.
constexpr double kRmseOffset = 0.5, kRelativeOffset = 0.03;
constexpr int kEvaluations = 400;
constexpr double kCommonF0 = 0.04;

ShortKind kind_of(const StudyPair& pair) {
  if (has_exponent(pair.target)) return ShortKind::kToExponent;
  if (!has_exponent(pair.source)) return ShortKind::kWidths;
  return is_normalised(pair.source) ? ShortKind::kExponentNormal : ShortKind::kExponent;
}

// Numbers copied; of an exponent what most importers do: the fourth root, and the F0 of glass.
LobeSurface copied(const ShortForm& form, const LobeMaterial& material) {
  if (form.kind == ShortKind::kWidths) return {material.alpha, material.specular, material.diffuse, false};
  if (form.kind == ShortKind::kToExponent)
    return {material.alpha, material.specular, material.diffuse, false};
  LobeSurface surface{material.alpha, {kCommonF0, kCommonF0, kCommonF0}, {}, false};
  for (std::size_t c = 0; c < 3; ++c) surface.diffuse[c] = (1.0 - kCommonF0) * material.diffuse[c];
  return surface;
}

// The constants where the search begins, and those that it may change.
struct Start {
  std::vector<double> constants;
  std::size_t searched = 0;  // the first ones
};

Start start_of(const ShortForm& form) {
  switch (form.kind) {
    case ShortKind::kWidths:
      return {{0.9, 0.1, 0.9, 0.1}, 4};
    case ShortKind::kExponent:
      return {{1.7, 4.0, 6.0, 2.0, is_mirrored(form.source) ? 3.0 : 1.0},
              is_mirrored(form.source) ? std::size_t{5} : std::size_t{4}};
    case ShortKind::kExponentNormal:
      return {{1.4, 4.0, 0.6, is_mirrored(form.source) ? 3.0 : 1.0},
              is_mirrored(form.source) ? std::size_t{4} : std::size_t{3}};
    case ShortKind::kToExponent:
      return {{1.6, 7.0, is_mirrored(form.target) ? 3.0 : 1.0},
              is_mirrored(form.target) ? std::size_t{3} : std::size_t{2}};
  }
  return {};
}

std::vector<LobeMaterial> materials_of(const ShortForm& form, Half half) {
  switch (form.kind) {
    case ShortKind::kWidths:
      return width_materials(form.source, half);
    case ShortKind::kToExponent:
      return core_materials(form.source, half);
    default:
      return exponent_materials(form.source, half);
  }
}

// How much larger the errors are than the least possible ones, the mean of both kinds; 1 is perfect.
double badness(const std::vector<RuleError>& errors, const std::vector<LeastError>& least) {
  double sum = 0.0;
  for (std::size_t m = 0; m < errors.size(); ++m)
    sum += (errors[m].rmse + kRmseOffset) / (least[m].error.rmse + kRmseOffset) +
           (errors[m].relative + kRelativeOffset) / (least[m].error.relative + kRelativeOffset);
  return sum / (2.0 * static_cast<double>(errors.size()));
}

constexpr int kConstantDigits = 3;

// The best constants of a form, rounded, and how bad they are.
double choose_constants(const RuleJudge& judge, const std::vector<LeastError>& least, ShortForm& form) {
  const Start start = start_of(form);
  const auto with = [&](const std::vector<double>& searched) {
    ShortForm tried = form;
    tried.constants = start.constants;
    std::ranges::copy(searched, tried.constants.begin());
    return tried;
  };
  const auto value = [&](const std::vector<double>& searched) {
    const ShortForm tried = with(searched);
    const bool is_possible = form.kind == ShortKind::kWidths ||
                             std::ranges::all_of(searched, [](double constant) { return constant > 0.0; });
    if (!is_possible) return 1e9;
    return badness(judge.errors(FormRule(tried)), least);
  };
  std::vector<double> best = simplex_search(
      {start.constants.begin(), start.constants.begin() + static_cast<std::ptrdiff_t>(start.searched)}, 0.2,
      kEvaluations, value);
  for (double& constant : best) constant = rounded(constant, kConstantDigits);
  form.constants = with(best).constants;
  return value(best);
}

// The best constants and the best kind of strength, by the lights and materials that choose.
ShortForm chosen_form(LobeBank& bank, const StudyPair& pair) {
  ShortForm form{converter_id(pair.source, pair.target),
                 pair.source,
                 pair.target,
                 kind_of(pair),
                 ShortStrength::kLine,
                 {},
                 {},
                 {},
                 {},
                 {}};
  const RuleJudge chooser(bank.lights(), bank.of(pair.source), bank.of(pair.target),
                          materials_of(form, Half::kChoosing));
  form.constants = start_of(form).constants;
  // The start lies near enough for the search of the least errors, which is for a width and a strength.
  const std::vector<LeastError> least = chooser.least(FormRule(form));
  double lowest = 1e300;
  ShortForm best = form;
  for (const auto& strength : kShortStrengths) {
    if (form.kind != ShortKind::kWidths && strength.value != ShortStrength::kLine) continue;
    ShortForm tried = form;
    tried.strength = strength.value;
    const double value = choose_constants(chooser, least, tried);
    if (value < lowest) {
      lowest = value;
      best = tried;
    }
  }
  return best;
}

// Of the form, the best possible parameters and copied numbers.
void add_figures(const RuleJudge& judge, ShortForm& form) {
  form.figures = judge.by_rule(FormRule(form)).figures;
  form.best = judge.by_least(FormRule(form)).figures;
  form.copied = judge.by_rule([&](const LobeMaterial& material) { return copied(form, material); }).figures;
}

}  // namespace

std::vector<StudyPair> short_pairs() {
  constexpr std::array kHub = {"mitsuba/ward",  "mitsuba/ward-duer", "mitsuba/ward-balanced",
                               "mitsuba/phong", "mitsuba/beckmann",  "mitsuba/ggx",
                               "mitsuba/as"};
  std::vector<StudyPair> pairs;
  for (const char* lobe :
       {"legacy/blinn-phong", "legacy/phong", "legacy/blinn-phong-normalised", "legacy/phong-normalised"})
    pairs.push_back({lobe, "mitsuba/ggx"});
  for (const char* lobe : {"legacy/blinn-phong", "legacy/phong"}) pairs.push_back({"mitsuba/ggx", lobe});
  for (const char* source : kHub)
    for (const char* target : kHub)
      if (std::string(source) != target) pairs.push_back({source, target});
  return pairs;
}

void study_short_forms(const ShortFormsOptions& options,
                       const std::function<void(const ShortForm&)>& finished) {
  if (options.choosing.empty() || options.judging.empty())
    throw Error(ErrorKind::kUsage, "short: lights to choose by, and others to judge by, are required");
  LobeBank choosing(options.choosing, options), judging(options.judging, options);
  for (const StudyPair& pair : options.pairs) {
    if (options.cancelled != nullptr && *options.cancelled)
      throw Error(ErrorKind::kInterrupted, "study: interrupted; finished forms are written");
    const auto known =
        std::ranges::find(options.known, converter_id(pair.source, pair.target), &ShortForm::id);
    const bool is_known = known != options.known.end();
    ShortForm form = is_known ? *known : chosen_form(choosing, pair);
    const RuleJudge judge(judging.lights(), judging.of(pair.source), judging.of(pair.target),
                          materials_of(form, Half::kJudging));
    if (!is_known) add_figures(judge, form);
    form.compiled.reset();
    if (const Fit* fit = fit_of(options.fits, form))
      form.compiled = judge.by_rule(compiled_rule(*fit, form)).figures;
    finished(form);
  }
}

}  // namespace remap
