// Training of fully connected networks of any number of inputs and outputs, with Eigen and Ceres.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fit/network/samples.hpp"
#include "fit/rows/regression.hpp"

namespace remapc {

// The defaults were chosen on the table that Sztrajman et al. published (2019): two layers of 8 reach there
// what two of 16 reach, in an eighth of the time. tests/compiler/mlp_test.cpp states the errors.
struct TrainingOptions {
  std::vector<std::size_t> hidden = {8, 8};  // units of each hidden layer; none: a linear map
  remap::Activation activation = remap::Activation::kTanh;
  std::uint64_t seed = 1;             // of the initial weights and of the validation rows
  std::size_t starts = 4;             // independent trainings, at least 1; the best is kept
  double validation_fraction = 0.15;  // of the rows, 0 to 0.5; 0: the training rows say when to stop
  // Times the sum of squared weights, beside the mean squared error. On the published table 1e-9 halves what
  // a polynomial of low degree leaves of the network, for an error on unseen rows of 2.1e-5 instead
  // of 1.3e-5.
  double weight_decay = 1e-9;
  unsigned jobs = 0;  // threads; 0: one a processor. The result does not depend on it
};

// What the options of a kind of fit say of it.
template <typename Options>
TrainingOptions training_options(const Options& options) {
  TrainingOptions training;
  training.hidden = options.hidden;
  training.activation = options.activation;
  training.seed = options.seed;
  training.starts = options.starts;
  training.jobs = options.jobs;
  return training;
}

struct TrainedNetwork {
  remap::Network network;
  double training_rms = 0.0;    // over the rows it was trained on, in units of the normalised outputs
  double validation_rms = 0.0;  // of the best start, before its refit to all rows; same units
  std::size_t best_start = 0;
  std::size_t rows = 0;  // that were used, validation rows included; fewer than given where those are many
  std::string method;    // one line: layers, optimisers, starts, iterations, rows
};

// Least squares on outputs of mean 0 and variance 1, inputs in [-1, 1] over the rows (an input or output that
// is constant is only shifted).
//
// Networks of up to 600 numbers are trained by Levenberg-Marquardt; the best start is then refitted to all
// rows, validation included (on the published table the error on unseen rows falls by 7 % in the mean).
// Larger networks are trained by Adam with a rising and falling step, then by L-BFGS. Each start keeps the
// weights of its best validation error. Of very many rows a seeded subset is used, so that time stays
// bounded: `rows` and `method` say so.
//
// The same samples and options give the same bytes on one machine, whatever `jobs` is. `progress` is called
// by one thread at a time, with shares that never fall; what it throws ends all threads and is thrown here.
// Throws kInput for fewer than 10 rows, rows of uneven length or numbers that are not finite, kUsage for a
// layer without units or options outside their range, kNumeric where no start gives finite errors.
TrainedNetwork train_network(const Samples& samples, const TrainingOptions& options,
                             const FitProgress& progress = {});

}  // namespace remapc
