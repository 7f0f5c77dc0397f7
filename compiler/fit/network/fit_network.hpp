// This file trains fully connected networks with any number of inputs and outputs. mlp.cpp fits the small
// networks of sections 5.1 and 8 (Sztrajman et al. 2019), one for each output. material_network.cpp trains a
// network that converts specular to metallic materials. Its table has pairs of a metallic and a specular
// material with the same pictures (section 8).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lower/fit_file.hpp"
#include "table/regression.hpp"
#include "table/table.hpp"

namespace remap {

// The defaults were chosen on the table that Sztrajman et al. (2019) published. Two layers of 8 units are as
// accurate as two layers of 16, and train in an eighth of the time. tests/compiler/fit/network/mlp_test.cpp
// states the errors.
struct TrainingOptions {
  std::vector<std::size_t> hidden = {8, 8};  // units of each hidden layer; if empty, a linear map
  Activation activation = Activation::kTanh;
  std::uint64_t seed = 1;             // seed of initial weights and validation rows
  std::size_t starts = 4;             // independent trainings, at least 1; the best is kept
  double validation_fraction = 0.15;  // fraction of rows, 0 to 0.5; 0: validate on the training rows
  // This is the weight of the sum of squared weights. On the published table, 1e-9 halves the error of a
  // polynomial of low degree that is fitted to the network. The error on unseen rows rises from 1.3e-5 to
  // 2.1e-5.
  double weight_decay = 1e-9;
  unsigned jobs = 0;  // threads; 0: one per core. The result does not depend on it
};

struct TrainedNetwork {
  Network network;
  double training_rms = 0.0;    // over the training rows, in normalised units
  double validation_rms = 0.0;  // of the best start before its refit to all rows; in normalised units
  std::size_t best_start = 0;
  // number of used rows, with validation rows; may be smaller than the number of given rows
  std::size_t rows = 0;
  std::string method;  // one line: layers, optimisers, starts, iterations, rows
};

// Minimizes squared errors of outputs with mean 0 and variance 1, for inputs in [-1, 1] over the rows.
// Constant inputs and outputs are only shifted.
//
// Networks of up to 600 parameters are trained by Levenberg-Marquardt. The best start is then refitted to all
// rows, including the validation rows. On the published table, this reduces the error on unseen rows by 7 %
// on average. Larger networks are trained by Adam and then by L-BFGS. Each start keeps the weights with its
// smallest validation error. If there are very many rows, a random subset is used, which `rows` and `method`
// record.
//
// On one machine, equal samples and options give the same bytes for any `jobs`. `progress` is called by one
// thread at a time, with fractions that never decrease. An exception from it ends all threads and is thrown
// again. Throws kInput for fewer than 10 rows, rows of different length or numbers that are not finite.
// Throws kUsage for a layer without units or options out of range, and kNumeric if no start gives finite
// errors.
TrainedNetwork train_network(const Samples& samples, const TrainingOptions& options,
                             const FitProgress& progress = {});

// Fits `rows` (all of status ok, finite) with alpha and specular as inputs. If alpha_needs_specular() returns
// false, target alpha is fitted from source alpha only. Some of `rows`, drawn at random, are validation rows,
// which determine when the training ends. `method` has RMS errors in units of alpha and specular: over
// the training rows, and over the validation rows before the last iterations, which train on them, too.
// Throws kInput for fewer than 10 rows or a constant input, kUsage for a layer without units, kNumeric if no
// start converges, and the exceptions of `progress`.
Regression fit_mlp(const std::vector<TableRow>& rows, const TrainingOptions& options,
                   const FitProgress& progress = {});

// The defaults of MaterialNetworkOptions describe the network of the paper.
struct MaterialNetworkOptions : TrainingOptions {
  MaterialNetworkOptions() {
    hidden = {300};
    activation = Activation::kRelu;
    starts = 1;
  }
  std::string id;                  // if empty, `<specular model>_to_<metallic model>`
  double held_out_fraction = 0.1;  // fraction of the rows that only measure the errors of the fit
};

// Trains the inverse of a table of `remapc sample`. The table goes from a metallic model (columns
// base_color_r1, ..., metallic1) to a specular model (f0_r2, ..., diffuse_r2, ...). `bytes` is the file of
// the table. Only rows of status ok are used. Diffuse is plain. The roughness conventions come from the
// table's models. Throws kInput for missing columns, for a table without rows, and if rows deviate from
// equation (2) by more than 1e-3 (RMS). Throws kUsage for an invalid id or fraction, and the errors of
// train_network().
WorkflowFit fit_material_network(const MaterialTable& table, std::string_view bytes,
                                 const MaterialNetworkOptions& options, const FitProgress& progress = {});

}  // namespace remap
