#include "study/conversions.hpp"

#include <algorithm>

#include "lower/lower.hpp"
#include "remap/error.hpp"
#include "sweep/sweep.hpp"

namespace remapc {
namespace {

// The target parameters for each alpha of the options.
using Parameters = std::vector<SamplePoint>;

Parameters copied(const EnvironmentsOptions& options) {
  Parameters parameters;
  for (const double alpha : options.alphas) parameters.push_back({alpha, options.specular});
  return parameters;
}

Parameters matched(const EnvironmentsOptions& options, const Renderer& renderer, const ModelPair& pair,
                   const std::string& objective) {
  SweepOptions sweep;
  sweep.source = pair.source;
  sweep.target = pair.target;
  sweep.objective = objective_preset(objective);
  sweep.objective_name = objective;
  sweep.resolution = options.match_resolution;
  sweep.samples = copied(options);
  SweepExecution execution;
  execution.jobs = options.jobs;
  execution.cancelled = options.cancelled;
  Parameters parameters;
  for (const TableRow& row : run_sweep(renderer, sweep, execution).rows)
    parameters.push_back({row.alpha2, row.specular2});
  return parameters;
}

// Evaluates the fit as generated headers and texremap do: as polynomials in floats, after the domain rule
// (model/interpreter.hpp).
Parameters shipped(const EnvironmentsOptions& options, const remap::Fit& fit) {
  const remap::Lowered lowered = remap::lower(fit.mapping, fit.domain);
  const double held_specular = std::min(options.specular, fit.domain.specular.max);
  const double scale = held_specular > 0.0 ? options.specular / held_specular : 1.0;
  Parameters parameters;
  for (const double alpha : options.alphas) {
    const auto width = static_cast<float>(std::clamp(alpha, fit.domain.alpha.min, fit.domain.alpha.max));
    const auto specular = static_cast<float>(held_specular);
    const double target_specular =
        static_cast<double>(remap::value(lowered.specular.polynomial, width, specular));
    parameters.push_back({static_cast<double>(remap::value(lowered.alpha.polynomial, width, specular)),
                          std::max(0.0, target_specular * scale)});
  }
  return parameters;
}

const remap::Fit* find_pair(const std::vector<remap::Fit>& fits, const ModelPair& pair) {
  const auto fit = std::find_if(fits.begin(), fits.end(), [&](const remap::Fit& candidate) {
    return candidate.source.model == pair.source && candidate.target.model == pair.target;
  });
  return fit == fits.end() ? nullptr : &*fit;
}

}  // namespace

std::vector<Conversion> conversions_of(const EnvironmentsOptions& options,
                                       std::vector<std::string>* remarks) {
  const auto renderer = make_builtin_renderer();
  std::vector<Conversion> conversions;
  const auto add = [&](std::size_t pair, Method method, const Parameters& parameters) {
    for (std::size_t i = 0; i < parameters.size(); ++i)
      conversions.push_back({pair, method, options.alphas[i], parameters[i].alpha, parameters[i].specular});
    if (options.progress) options.progress();
  };
  for (std::size_t p = 0; p < options.pairs.size(); ++p) {
    const ModelPair& pair = options.pairs[p];
    add(p, Method::kCopy, copied(options));
    add(p, Method::kPaper, matched(options, *renderer, pair, "paper"));
    add(p, Method::kNatural, matched(options, *renderer, pair, "natural"));
    const remap::Fit* fit = find_pair(options.fits, pair);
    add(p, Method::kShipped, fit == nullptr ? Parameters{} : shipped(options, *fit));
    if (fit == nullptr) remarks->push_back(pair_name(pair) + " has no fit, so `shipped` is not compared");
  }
  std::stable_sort(conversions.begin(), conversions.end(),
                   [](const Conversion& a, const Conversion& b) { return a.alpha < b.alpha; });
  return conversions;
}

}  // namespace remapc
