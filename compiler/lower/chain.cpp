#include "lower/chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "lower/form_fit.hpp"
#include "lower/interpreter.hpp"
#include "remap/version.hpp"

namespace remap {
namespace {

constexpr double kSpecularWeight = 0.25;

constexpr int kAlphas = 401, kSpeculars = 64;  // size of the grid that finds the domain
constexpr int kCoarse = 25;                    // size of the grid on which errors are propagated
constexpr double kSameEdge = 1e-9;             // relative tolerance for the edge of a domain
// A form may differ from its steps by this much, which pictures do not show.
constexpr double kNearAlpha = 2e-3, kNearSpecular = 4e-3;

double at(const Range& range, int i, int count) {
  return i + 1 == count ? range.max : range.min + (range.max - range.min) * i / (count - 1);
}

std::string range_text(const Range& range) {
  return number_text(rounded_up(range.min, 4)) + " to " + number_text(rounded_up(range.max, 4));
}

void require_links(const std::vector<Fit>& steps) {
  if (steps.size() < 2) throw usage_error("chain: only one fit (give at least 2)");
  std::set<std::string> visited = {steps.front().source.model};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i > 0 && steps[i - 1].target != steps[i].source)
      throw input_error("chain: " + steps[i - 1].id + " converts to " + side_text(steps[i - 1].target) +
                        ", but " + steps[i].id + " converts from " + side_text(steps[i].source) +
                        " (add a step between them)");
    if (!visited.insert(steps[i].target.model).second)
      throw usage_error("chain: " + steps[i].id + " leads to " + steps[i].target.model +
                        " a second time (remove a step)");
  }
}

// Returns the inputs of every step, and after these the outputs of the last step.
std::vector<MappedTexel> states(const std::vector<Fit>& steps, MappedTexel texel) {
  std::vector<MappedTexel> passed = {texel};
  for (const Fit& step : steps) {
    texel = evaluate_fit(step, texel.alpha, texel.specular);
    passed.push_back(texel);
  }
  return passed;
}

bool covers(const Range& range, double value) {
  return value >= range.min * (1.0 - kSameEdge) && value <= range.max * (1.0 + kSameEdge);
}

// Returns the first step whose domain a texel leaves. If the target of a step is at its limit, returns the
// next step. Otherwise returns steps.size(). The domain rule handles specular below 0.
std::size_t leaves(const std::vector<Fit>& steps, const MappedTexel& texel) {
  const std::vector<MappedTexel> passed = states(steps, texel);
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (!is_inside(steps[i - 1], passed[i - 1].alpha, passed[i - 1].specular) ||
        !covers(steps[i].domain.alpha, passed[i].alpha) ||
        passed[i].specular > steps[i].domain.specular.max * (1.0 + kSameEdge))
      return i;
  return steps.size();
}

[[noreturn]] void refuse_domains(const std::vector<Fit>& steps) {
  const Domain& first = steps.front().domain;
  const double specular = first.specular.max / kSpeculars;
  const std::size_t left = leaves(steps, {0.5 * (first.alpha.min + first.alpha.max), specular});
  const std::size_t i = left == steps.size() ? 1 : left;
  Range reached{INFINITY, -INFINITY};
  for (int k = 0; k < kCoarse; ++k) {
    const double alpha = states(steps, {at(first.alpha, k, kCoarse), specular})[i].alpha;
    reached = {std::min(reached.min, alpha), std::max(reached.max, alpha)};
  }
  throw input_error("chain: the domains of the steps do not meet: before " + steps[i].id + ", alpha is " +
                    range_text(reached) + ", but this fit covers alpha " + range_text(steps[i].domain.alpha) +
                    " and specular to " + number_text(steps[i].domain.specular.max));
}

Domain chain_domain(const std::vector<Fit>& steps) {
  const Domain& first = steps.front().domain;
  std::vector<CoveredColumn> columns;
  for (int i = 0; i < kAlphas; ++i) {
    const double alpha = at(first.alpha, i, kAlphas);
    CoveredColumn column{alpha, alpha, 0.0, false};
    for (int j = 0; j <= kSpeculars; ++j) {
      const double specular = first.specular.max * j / kSpeculars;
      if (leaves(steps, {alpha, specular}) != steps.size()) break;
      column.reach = specular;
    }
    columns.push_back(column);
  }
  const auto domain = covered_box(columns);
  if (!domain || !(domain->alpha.min < domain->alpha.max)) refuse_domains(steps);
  return *domain;
}

// A Jacobian holds derivatives by the inputs of step `first`: [output][input], alpha then specular.
using Jacobian = std::array<std::array<double, 2>, 2>;

Jacobian jacobian(const std::vector<Fit>& steps, std::size_t first, const MappedTexel& texel) {
  const std::vector<Fit> rest(steps.begin() + static_cast<std::ptrdiff_t>(first), steps.end());
  const auto difference = [&](double alpha_step, double specular_step) {
    const MappedTexel high = states(rest, {texel.alpha + alpha_step, texel.specular + specular_step}).back();
    const MappedTexel low = states(rest, {texel.alpha - alpha_step, texel.specular - specular_step}).back();
    const double length = 2.0 * (alpha_step + specular_step);
    return std::array{(high.alpha - low.alpha) / length, (high.specular - low.specular) / length};
  };
  const auto by_alpha = difference(1e-4 * texel.alpha, 0.0), by_specular = difference(0.0, 1e-5);
  return {{{by_alpha[0], by_specular[0]}, {by_alpha[1], by_specular[1]}}};
}

// Adds the errors of one step to the errors of an output, `here` at one place and `all` over all places.
// `row` holds the derivatives of the output. Until the end, `rms` of all places is the sum of squares.
void add_step(const std::array<double, 2>& row, const Fit& step, ErrorFigures* here, ErrorFigures* all) {
  const double a = std::fabs(row[0]), s = std::fabs(row[1]);
  const ErrorFigures &alpha = step.alpha_error, &specular = step.specular_error;
  all->rms += a * a * alpha.rms * alpha.rms + s * s * specular.rms * specular.rms;
  here->p99 += a * alpha.p99 + s * specular.p99;
  here->max += a * alpha.max + s * specular.max;
}

void raise(const ErrorFigures& here, ErrorFigures* all) {
  all->p99 = std::max(all->p99, here.p99);
  all->max = std::max(all->max, here.max);
}

// Propagates the errors of all steps to the end of the chain. Rms errors are added as squares and averaged
// over the domain. Other errors are added, and the maximum over the domain is used.
void carry_errors(const std::vector<Fit>& steps, Fit* chain) {
  ErrorFigures &alpha = chain->alpha_error, &specular = chain->specular_error;
  for (int i = 0; i < kCoarse; ++i)
    for (int j = 1; j <= kCoarse; ++j) {
      const std::vector<MappedTexel> passed =
          states(steps, {at(chain->domain.alpha, i, kCoarse), chain->domain.specular.max * j / kCoarse});
      ErrorFigures alpha_here, specular_here;
      for (std::size_t s = 0; s < steps.size(); ++s) {
        if (!steps[s].follows_rows()) continue;
        const Jacobian rest = s + 1 == steps.size() ? Jacobian{{{1.0, 0.0}, {0.0, 1.0}}}
                                                    : jacobian(steps, s + 1, passed[s + 1]);
        add_step(rest[0], steps[s], &alpha_here, &alpha);
        add_step(rest[1], steps[s], &specular_here, &specular);
      }
      raise(alpha_here, &alpha);
      raise(specular_here, &specular);
    }
  for (ErrorFigures* figures : {&alpha, &specular})
    figures->rms = std::sqrt(figures->rms / (kCoarse * kCoarse));
}

std::optional<ErrorFigures> summed_image_error(const std::vector<Fit>& steps) {
  ErrorFigures sum;
  for (const Fit& step : steps) {
    if (!step.image_error) return std::nullopt;
    sum.rms += step.image_error->rms;
    sum.p99 += step.image_error->p99;
    sum.max += step.image_error->max;
  }
  return sum;
}

// Returns the smallest form that reproduces the steps, or the largest form if none is close enough.
CompactForm composed_form(const std::vector<Fit>& steps, const Fit& chain) {
  std::vector<FormSample> samples;
  double largest = 0.0;
  for (int i = 0; i < kCoarse; ++i)
    for (int j = 1; j <= kCoarse; ++j) {
      const MappedTexel source{at(chain.domain.alpha, i, kCoarse), chain.domain.specular.max * j / kCoarse};
      samples.push_back({source, states(steps, source).back(), false, false});
      largest = std::max(largest, samples.back().target.specular);
    }
  CompactForm form;
  for (const FormShape& shape : form_shapes()) {
    form = within_limits(fit_form(samples, chain.limits, chain.domain, shape), chain.domain, chain.limits);
    if (!is_sound(form, chain.domain)) continue;
    const bool is_near = std::ranges::all_of(samples, [&](const FormSample& sample) {
      const MappedTexel found = form_texel(form, chain.domain, sample.source.alpha, sample.source.specular);
      return std::fabs(found.alpha - sample.target.alpha) <= kNearAlpha &&
             std::fabs(found.specular - sample.target.specular) <= kNearSpecular * largest;
    });
    if (is_near) return form;
  }
  return form;
}

// Converts a texel by the steps, each with its domain rule, in the models' own parameters. Returns alpha and
// replaces `specular`.
double step_by_step(const std::vector<Fit>& steps, double alpha, std::array<double, 3>& specular) {
  double own = from_alpha(steps.front().source.roughness, alpha);
  for (const Fit& step : steps) own = evaluate_texel(step, own, std::array(specular), specular);
  return to_alpha(steps.back().target.roughness, own);
}

constexpr double kSameEnd = 1e-12;  // tolerance for a range's end, relative to its value
constexpr int kHalvings = 60;

// Returns the argument within `range` at which a rising function takes `value`, if there is one.
std::optional<double> root(const std::function<double(double)>& rising, const Range& range, double value) {
  const double room = kSameEnd * std::fabs(value);
  double low = range.min, high = range.max;
  if (!(rising(low) <= value + room) || !(rising(high) >= value - room)) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

constexpr int kReturnedAlphas = 60, kReturnedSpeculars = 20;
constexpr double kMedianGoal = 0.005, kP99Goal = 0.02;

// Returns the quantile, by the closest rank.
double quantile(std::vector<double>* values, double share) {
  if (values->empty()) return 0.0;
  const double last = static_cast<double>(values->size());
  const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(share * last)));
  std::ranges::sort(*values);
  return (*values)[rank - 1];
}

}  // namespace

std::optional<Domain> covered_box(const std::vector<CoveredColumn>& columns) {
  std::optional<Domain> best;
  double best_score = -1.0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].is_gap) continue;
    double reach = INFINITY;
    for (std::size_t j = i; j < columns.size(); ++j) {
      if (columns[j].is_gap) continue;
      reach = std::min(reach, columns[j].reach);
      if (!(reach > 0.0)) break;
      const double score = (columns[j].last - columns[i].first) * std::pow(reach, kSpecularWeight);
      if (!(score > best_score)) continue;
      best_score = score;
      best = Domain{{columns[i].first, columns[j].last}, {0.0, reach}};
    }
  }
  return best;
}

Fit compose(const std::vector<Fit>& steps, const std::string& id) {
  require_links(steps);
  Fit chain;
  chain.source = steps.front().source;
  chain.target = steps.back().target;
  chain.id = id.empty() ? converter_id(chain.source.model, chain.target.model) : id;
  if (!is_valid_id(chain.id)) throw usage_error("chain: invalid id '" + chain.id + "' (use " + kIdRule + ")");
  chain.domain = chain_domain(steps);
  chain.limits = steps.back().limits;
  chain.mapping = composed_form(steps, chain);
  carry_errors(steps, &chain);
  chain.image_error = summed_image_error(steps);
  chain.tool_version = kVersion;
  const ChainDifference difference = difference_from_steps(chain, steps);
  const auto digits = [](double value) { return number_text(rounded_up(value, 2)); };
  chain.method["against its steps one after another"] =
      "alpha within " + digits(difference.alpha) + ", specular within " + digits(difference.grey_specular) +
      " for grey texels, " + digits(difference.color_specular) + " for colored ones; sampled";
  chain.method["errors"] = "those of the steps that follow rows, carried on to the end to first order";
  std::string names;
  for (const Fit& step : steps) names += (names.empty() ? "" : ", then ") + step.id;
  chain.remarks.push_back("Composed of " + names + ".");
  return chain;
}

ChainDifference difference_from_steps(const Fit& chain, const std::vector<Fit>& steps) {
  ChainDifference difference;
  for (int i = 0; i < kCoarse; ++i)
    for (int j = 0; j <= kCoarse; ++j) {
      const double alpha = at(chain.domain.alpha, i, kCoarse);
      const double top = chain.domain.specular.max * j / kCoarse;
      for (int k = 0; k <= kCoarse; ++k) {
        std::array<double, 3> stepped = {top, top * k / kCoarse, 0.0}, one = stepped;
        const double stepped_alpha = step_by_step(steps, alpha, stepped),
                     one_alpha = step_by_step({chain}, alpha, one);
        difference.alpha = std::max(difference.alpha, std::fabs(one_alpha - stepped_alpha));
        for (std::size_t c = 0; c < one.size(); ++c) {
          const double off = std::fabs(one[c] - stepped[c]);
          difference.color_specular = std::max(difference.color_specular, off);
          if (c == 0) difference.grey_specular = std::max(difference.grey_specular, off);
        }
      }
    }
  return difference;
}

std::optional<MappedTexel> inverse(const Fit& fit, const MappedTexel& target) {
  const MappingKind& mapping = fit.mapping;
  const Domain& domain = fit.domain;
  // Returns the specular that is needed at an alpha, clamped to the domain. The last test below rejects
  // clamped values.
  const auto specular_at = [&](double alpha) {
    const auto rising = [&](double specular) { return evaluate_mapping(mapping, alpha, specular).specular; };
    if (rising(domain.specular.min) >= target.specular) return domain.specular.min;
    return root(rising, domain.specular, target.specular).value_or(domain.specular.max);
  };
  const auto rising = [&](double alpha) {
    return evaluate_mapping(mapping, alpha, specular_at(alpha)).alpha;
  };
  const std::optional<double> alpha = root(rising, domain.alpha, target.alpha);
  if (!alpha) return std::nullopt;
  const double specular = specular_at(*alpha);
  const double reached = evaluate_mapping(mapping, *alpha, specular).specular;
  if (!(std::fabs(reached - target.specular) <= 1e-9 * domain.specular.max)) return std::nullopt;
  return MappedTexel{*alpha, specular};
}

RoundTrip round_trip(const Fit& there, const Fit& back) {
  std::vector<double> alphas, speculars;
  for (int i = 0; i < kReturnedAlphas; ++i)
    for (int j = 1; j <= kReturnedSpeculars; ++j) {
      const Range& range = there.domain.alpha;
      const double alpha = range.min + (range.max - range.min) * i / (kReturnedAlphas - 1);
      const double specular = there.domain.specular.max * j / kReturnedSpeculars;
      const MappedTexel far = evaluate_fit(there, alpha, specular);
      if (!is_inside(there, alpha, specular) || !back.domain.alpha.contains(far.alpha) ||
          !back.domain.specular.contains(far.specular) || !is_inside(back, far.alpha, far.specular))
        continue;
      const MappedTexel home = evaluate_fit(back, far.alpha, far.specular);
      alphas.push_back(std::fabs(home.alpha - alpha) / alpha);
      speculars.push_back(std::fabs(home.specular - specular) / specular);
    }
  RoundTrip trip;
  trip.share = static_cast<double>(alphas.size()) / (kReturnedAlphas * kReturnedSpeculars);
  trip.alpha_median = quantile(&alphas, 0.5);
  trip.alpha_p99 = quantile(&alphas, 0.99);
  trip.specular_median = quantile(&speculars, 0.5);
  trip.specular_p99 = quantile(&speculars, 0.99);
  return trip;
}

bool returns(const RoundTrip& trip) {
  return trip.share > 0.0 && trip.alpha_median <= kMedianGoal && trip.specular_median <= kMedianGoal &&
         trip.alpha_p99 <= kP99Goal && trip.specular_p99 <= kP99Goal;
}

}  // namespace remap
