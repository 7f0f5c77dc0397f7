// This file holds samples to train on, and the result of every regression: a mapping and how it was found.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "table/table.hpp"

namespace remap {

// A Samples holds the training data: rows of `input_count` inputs and `output_count` outputs.
struct Samples {
  std::size_t input_count = 0;
  std::size_t output_count = 0;
  std::vector<double> inputs;
  std::vector<double> outputs;
  std::size_t count() const noexcept { return input_count == 0 ? 0 : inputs.size() / input_count; }
};

struct Regression {
  MappingKind mapping;
  std::map<std::string, std::string> method;  // recorded in the fit: hyper-parameters, search, starts
};

// A FitProgress is called repeatedly with the finished fraction of the work, 0 to 1, from any thread. An
// exception from it ends the regression. It may be empty.
using FitProgress = std::function<void(double share)>;

// Returns the progress for a part of the work that goes from the fraction `begin` to the fraction `end`. It
// refers to `progress`, and is empty if `progress` is empty.
FitProgress part_of(const FitProgress& progress, double begin, double end);

// Returns the weight of an output's error when fits are compared: 1 / value, but at most 50. Pictures show
// errors relative to the value, but no errors of values below a fiftieth.
double error_weight(double value);

// Throws kInput for fewer than 10 rows, or if alpha1 or specular1 is constant. The message starts with
// `kind`.
void require_variety(const std::vector<TableRow>& rows, const std::string& kind);

// Returns true if target alpha depends on specular at the same source alpha. For each alpha1, a straight line
// over specular is fitted to alpha2. The lines must explain more than the residuals leave. If this is false,
// target alpha is fitted from source alpha only.
bool alpha_needs_specular(const std::vector<TableRow>& rows);

// Returns `id`. If it is empty, returns the id of a converter between the models. Throws kUsage for an
// invalid id.
std::string fit_id(const std::string& id, const std::string& source_model, const std::string& target_model);

}  // namespace remap
