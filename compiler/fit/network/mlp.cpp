#include <map>
#include <string>

#include "core/number_text.hpp"
#include "fit/network/fit_network.hpp"

namespace remap {
namespace {

Samples samples_of(const std::vector<TableRow>& rows, bool with_specular, double TableRow::*output) {
  Samples samples;
  samples.input_count = with_specular ? 2 : 1;
  samples.output_count = 1;
  for (const TableRow& row : rows) {
    samples.inputs.push_back(row.alpha1);
    if (with_specular) samples.inputs.push_back(row.specular1);
    samples.outputs.push_back(row.*output);
  }
  return samples;
}

void record(const std::string& name, const TrainedNetwork& trained,
            std::map<std::string, std::string>& method) {
  const double unit = 1.0 / trained.network.outputs.front().scale;
  method[name] = trained.method;
  method[name + "_training_rms"] = number_text(rounded_up(trained.training_rms * unit, 3));
  method[name + "_validation_rms"] = number_text(rounded_up(trained.validation_rms * unit, 3));
  method[name + "_best_start"] = std::to_string(trained.best_start + 1);
}

std::string hidden_text(const std::vector<std::size_t>& hidden) {
  std::string text;
  for (const std::size_t units : hidden) text += (text.empty() ? "" : " ") + std::to_string(units);
  return text.empty() ? "none" : text;
}

}  // namespace

Regression fit_mlp(const std::vector<TableRow>& rows, const TrainingOptions& options,
                   const FitProgress& progress) {
  require_variety(rows, "mlp");
  const Samples alpha_samples = samples_of(rows, alpha_needs_specular(rows), &TableRow::alpha2);
  const TrainedNetwork alpha = train_network(alpha_samples, options, part_of(progress, 0.0, 0.5));
  const TrainedNetwork specular =
      train_network(samples_of(rows, true, &TableRow::specular2), options, part_of(progress, 0.5, 1.0));

  Regression regression;
  regression.mapping = Mlp{alpha.network, specular.network};
  std::map<std::string, std::string>& method = regression.method;
  method["activation"] = std::string(activation_name(options.activation));
  method["hidden"] = hidden_text(options.hidden);
  method["seed"] = std::to_string(options.seed);
  method["starts"] = std::to_string(options.starts);
  method["weight_decay"] = number_text(options.weight_decay);
  record("alpha", alpha, method);
  record("specular", specular, method);
  return regression;
}

}  // namespace remap
