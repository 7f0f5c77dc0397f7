// This file converts samples to libsvm's data structures, trains, and converts the model to Gaussians.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <string_view>

#include <libsvm/svm.h>

#include "core/errors.hpp"
#include "fit/svr/svr.hpp"

namespace remap {
namespace {

constexpr long kIterationBound = 10'000'000;  // the limit of libsvm (Solver::Solve)
constexpr double kLargestTolerance = 1e-3;    // tolerance of the optimality conditions, the default of libsvm
// A larger factor would make fits less accurate. A smaller factor would only take more time.
constexpr double kToleranceOfEpsilon = 3.0;

// This is the number of iterations, which is read from libsvm's messages. libsvm does not report it in
// another way, and all threads share its print function.
thread_local long iteration_count = 0;

void listen(const char* message) {
  constexpr std::string_view kMark = "#iter = ";
  const std::string_view text(message);
  const auto found = text.find(kMark);
  if (found == std::string_view::npos) return;
  const char* begin = text.data() + found + kMark.size();
  std::from_chars(begin, text.data() + text.size(), iteration_count);
}

// Returns the inputs in libsvm's format: for each sample, a list of (index, value) that ends with index -1.
std::vector<svm_node> nodes_of(const Samples& samples, const std::vector<Scaling>& scalings) {
  std::vector<svm_node> nodes;
  nodes.reserve(samples.count() * (samples.input_count + 1));
  for (std::size_t i = 0; i < samples.count(); ++i) {
    for (std::size_t j = 0; j < samples.input_count; ++j)
      nodes.push_back(
          {static_cast<int>(j) + 1, normalised(scalings[j], samples.inputs[i * samples.input_count + j])});
    nodes.push_back({-1, 0.0});
  }
  return nodes;
}

// Scales alpha to [0, 1] over the samples, after the pole's transform. Scales specular by its span.
std::vector<Scaling> input_scalings(const Samples& samples, const SvrHyperParameters& parameters) {
  double low = samples.inputs[0], high = low;
  for (std::size_t i = 0; i < samples.inputs.size(); i += samples.input_count) {
    low = std::min(low, samples.inputs[i]);
    high = std::max(high, samples.inputs[i]);
  }
  const Scaling warp{0.0, 1.0, parameters.alpha_pole};
  low = normalised(warp, low);
  const double range = normalised(warp, high) - low;
  std::vector<Scaling> scalings = {
      {low, range > 0.0 && std::isfinite(1.0 / range) ? 1.0 / range : 1.0, parameters.alpha_pole}};
  if (samples.input_count > 1) scalings.push_back({0.0, parameters.specular_span});
  return scalings;
}

svm_parameter parameters_of(const SvrHyperParameters& given) {
  svm_parameter parameters{};
  parameters.svm_type = EPSILON_SVR;
  parameters.kernel_type = RBF;
  parameters.gamma = given.gamma;
  parameters.C = given.cost;
  parameters.p = given.epsilon;
  parameters.eps = std::min(kLargestTolerance, kToleranceOfEpsilon * given.epsilon);
  parameters.cache_size = 100.0;  // megabytes; 2000 samples need 32
  parameters.shrinking = 1;
  return parameters;
}

KernelExpansion expansion_of(const svm_model& model, std::vector<Scaling> inputs) {
  KernelExpansion expansion;
  const std::size_t input_count = inputs.size();
  expansion.inputs = std::move(inputs);
  expansion.gamma = model.param.gamma;
  expansion.bias = -model.rho[0];
  const auto count = static_cast<std::size_t>(model.l);
  for (std::size_t i = 0; i < count; ++i) {
    expansion.weights.push_back(model.sv_coef[0][i]);
    for (std::size_t j = 0; j < input_count; ++j) expansion.vectors.push_back(model.SV[i][j].value);
  }
  return expansion;
}

}  // namespace

std::optional<KernelExpansion> train_expansion(const Samples& samples, const SvrHyperParameters& parameters) {
  static std::once_flag listening;
  std::call_once(listening, [] { svm_set_print_string_function(listen); });

  const std::vector<Scaling> scalings = input_scalings(samples, parameters);
  std::vector<double> outputs = samples.outputs;
  std::vector<svm_node> nodes = nodes_of(samples, scalings);
  std::vector<svm_node*> lists;
  for (std::size_t i = 0; i < samples.count(); ++i) lists.push_back(&nodes[i * (samples.input_count + 1)]);
  const svm_problem problem{static_cast<int>(samples.count()), outputs.data(), lists.data()};
  const svm_parameter settings = parameters_of(parameters);
  if (const char* refusal = svm_check_parameter(&problem, &settings); refusal != nullptr)
    throw usage_error(std::string("libsvm refused the hyper-parameters: ") + refusal);
  iteration_count = 0;
  // The model refers to `nodes`, which must outlive it.
  const std::unique_ptr<svm_model, void (*)(svm_model*)> model(
      svm_train(&problem, &settings), [](svm_model* trained) { svm_free_and_destroy_model(&trained); });
  if (iteration_count >= kIterationBound) return std::nullopt;
  KernelExpansion expansion = expansion_of(*model, scalings);
  const auto finite = [](double number) { return std::isfinite(number); };
  if (!finite(expansion.bias) || !std::ranges::all_of(expansion.weights, finite)) return std::nullopt;
  return expansion;
}

std::string solver_name() {
  return "libsvm " + std::to_string(libsvm_version / 100) + "." + std::to_string(libsvm_version % 100);
}

}  // namespace remap
