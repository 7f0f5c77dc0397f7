// This file converts rows to samples, trains one expansion per output and records the method.
#include "fit/svr/svr.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>

#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr std::size_t kLargestTraining = 2000;  // samples; time grows faster than their square
constexpr int kSoftenings = 3;  // how often C is divided by ten if the final training does not converge
constexpr double kSoftening = 0.1;

// A Problem is one output of the table with its scalings.
struct Problem {
  std::string name;  // `alpha` or `specular`, as in `method`
  Samples samples;
  std::vector<Scaling> inputs;
  Scaling output;
};

// Scales `values` to [0, 1]; constant values become 0.
Scaling scaling_of(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  const double range = *high - *low;
  return {*low, range > 0.0 && std::isfinite(1.0 / range) ? 1.0 / range : 1.0};
}

// Combines rows with the same inputs to one sample with their mean output. Samples are sorted by inputs.
Problem make_problem(const std::string& name, const std::vector<TableRow>& rows, std::size_t input_count,
                     double TableRow::*output) {
  std::map<std::array<double, 2>, std::vector<double>> outputs_of;
  for (const TableRow& row : rows)
    outputs_of[{row.alpha1, input_count > 1 ? row.specular1 : 0.0}].push_back(row.*output);
  std::array<std::vector<double>, 2> inputs;
  std::vector<double> outputs;
  for (const auto& [input, values] : outputs_of) {
    for (std::size_t j = 0; j < input_count; ++j) inputs[j].push_back(input[j]);
    outputs.push_back(std::accumulate(values.begin(), values.end(), 0.0) /
                      static_cast<double>(values.size()));
  }
  Problem problem{name, {input_count, 1, {}, {}}, {}, scaling_of(outputs)};
  problem.inputs.push_back({});  // the training scales alpha, so it is not scaled here
  if (input_count > 1) problem.inputs.push_back(scaling_of(inputs[1]));
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t j = 0; j < input_count; ++j)
      problem.samples.inputs.push_back(normalised(problem.inputs[j], inputs[j][i]));
    problem.samples.outputs.push_back(normalised(problem.output, outputs[i]));
  }
  return problem;
}

void require_in_range(const SvrHyperParameters& parameters, const std::string& name) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!positive(parameters.cost) || !positive(parameters.gamma) || !positive(parameters.epsilon) ||
      !(parameters.specular_span > 0.0 && parameters.specular_span <= 1.0) ||
      !(parameters.alpha_pole >= 0.0 && std::isfinite(parameters.alpha_pole)))
    throw usage_error("svr " + name + ": invalid C " + number_text(parameters.cost) + ", gamma " +
                      number_text(parameters.gamma) + ", epsilon " + number_text(parameters.epsilon) +
                      ", specular_span " + number_text(parameters.specular_span) + ", alpha_pole " +
                      number_text(parameters.alpha_pole) +
                      " (C, gamma and epsilon must be above 0, the span above 0 to 1, the pole at least 0)");
}

// Trains on `samples`. If a search chose C, reduces C until libsvm converges.
KernelExpansion train(const std::string& name, const Samples& samples, bool is_given,
                      SvrHyperParameters& parameters) {
  for (int softening = 0; softening <= (is_given ? 0 : kSoftenings); ++softening) {
    if (softening > 0) parameters.cost *= kSoftening;
    if (auto expansion = train_expansion(samples, parameters)) return *expansion;
  }
  throw numeric_error("svr " + name + ": libsvm did not converge on " + std::to_string(samples.count()) +
                      " samples with C " + number_text(parameters.cost) + ", gamma " +
                      number_text(parameters.gamma) + " (use a smaller C)");
}

// If hyper-parameters are not given, searches them and stores them in `used`.
KernelExpansion fit_output(const Problem& problem, std::optional<SvrHyperParameters>* used,
                           const SvrOptions& options, const FitProgress& progress,
                           std::map<std::string, std::string>& method) {
  const auto record = [&](const std::string& key, const std::string& value) {
    method[problem.name + "." + key] = value;
  };
  const bool is_given = used->has_value();
  if (!is_given) used->emplace();
  SvrHyperParameters& parameters = **used;
  if (is_given) {
    require_in_range(parameters, problem.name);
  } else {
    const SvrChoice choice = search_hyper_parameters(problem.samples, options.seed, options.jobs, progress);
    parameters = choice.parameters;
    record("folds", std::to_string(choice.fold_count));
    record("candidates", std::to_string(choice.candidate_count));
    record("search_samples", std::to_string(choice.sample_count));
    record("cross_validation_rms", number_text(choice.rms / problem.output.scale));
  }
  const Samples training = draw_evenly(problem.samples, kLargestTraining, options.seed);
  KernelExpansion expansion = train(problem.name, training, is_given, parameters);
  if (expansion.inputs.size() > 1)
    expansion.inputs[1] = {problem.inputs[1].offset, problem.inputs[1].scale * expansion.inputs[1].scale};
  expansion.output = problem.output;
  record("C", number_text(parameters.cost));
  record("gamma", number_text(parameters.gamma));
  record("epsilon", number_text(parameters.epsilon));
  record("specular_span", number_text(parameters.specular_span));
  record("alpha_pole", number_text(parameters.alpha_pole));
  record("inputs", problem.inputs.size() > 1 ? "alpha, specular" : "alpha");
  record("vectors", std::to_string(expansion.count()));
  record("trained_samples", std::to_string(training.count()));
  return expansion;
}

// Returns a progress whose fractions never decrease, because threads finish in any order.
FitProgress rising(const FitProgress& progress) {
  if (!progress) return {};
  const auto mutex = std::make_shared<std::mutex>();
  return [&progress, mutex, reached = 0.0](double share) mutable {
    const std::lock_guard lock(*mutex);
    reached = std::max(reached, std::clamp(share, 0.0, 1.0));
    progress(reached);
  };
}

}  // namespace

Regression fit_svr(const std::vector<TableRow>& rows, const SvrOptions& options,
                   const FitProgress& progress) {
  require_variety(rows, "svr");
  const std::size_t alpha_inputs = alpha_needs_specular(rows) ? 2 : 1;
  const Problem alpha = make_problem("alpha", rows, alpha_inputs, &TableRow::alpha2);
  const Problem specular = make_problem("specular", rows, 2, &TableRow::specular2);

  Regression regression;
  regression.method["solver"] = solver_name() + ", epsilon-SVR, Gaussian kernel";
  regression.method["seed"] = std::to_string(options.seed);
  const FitProgress whole = rising(progress);
  // The first part of the progress bar is for alpha, the rest for specular.
  const double share_of_alpha = alpha_inputs > 1 ? 0.5 : 0.05;
  Svr svr;
  SvrOptions used = options;
  svr.alpha = fit_output(alpha, &used.alpha, options, part_of(whole, 0.0, share_of_alpha), regression.method);
  svr.specular =
      fit_output(specular, &used.specular, options, part_of(whole, share_of_alpha, 0.95), regression.method);
  regression.mapping = std::move(svr);
  if (progress) whole(1.0);
  return regression;
}

}  // namespace remap
