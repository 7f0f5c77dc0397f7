// This file does support vector regression (Sztrajman et al. 2019, section 5.1) with libsvm. It uses
// epsilon-SVR with radial basis functions, and one model per output. svm_training.cpp runs one training and
// is the only file that uses libsvm. svr_search.cpp chooses the hyper-parameters of one output by
// cross-validation. The stages are a coarse grid over the kernel, a pattern search around its best point, the
// choice of the smoothest equivalent kernel, and a search for the width of the tube.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lower/mapping.hpp"
#include "table/regression.hpp"

namespace remap {

// An SvrHyperParameters holds the hyper-parameters of one output, in normalised units. Alpha (or alpha /
// (alpha + alpha_pole)) and the output are scaled to [0, 1] over the training rows, and specular to [0,
// specular_span]. Target specular as a function of alpha is curved, mostly close to 0. As a function of
// specular, it is nearly straight. With a pole and a span below 1, one gamma fits both inputs.
struct SvrHyperParameters {
  double cost = 100.0;         // C, the penalty of errors above epsilon; > 0
  double gamma = 1.0;          // for exp(-gamma |x - y|^2); > 0
  double epsilon = 1e-3;       // half width of the tube without penalty; > 0
  double specular_span = 1.0;  // (0, 1]; unused if alpha is the only input
  double alpha_pole = 0.0;     // at least 0, in units of alpha; 0: no transform
  bool operator==(const SvrHyperParameters&) const = default;
};

// Trains an epsilon-SVR with Gaussian kernel on `samples` (at least 1, finite) of one output. Their inputs
// are alpha, or alpha and specular. Alpha is unchanged, specular and output are normalised to [0, 1]. Alpha
// is normalised over the samples and specular is multiplied by specular_span. The result contains these
// scalings, so it has the units of `samples`. Returns nothing if libsvm stopped at its limit of 10^7
// iterations or found no finite solution. Thread-safe; the same samples in the same order give the same bits.
// Throws kUsage if libsvm refuses the hyper-parameters.
std::optional<KernelExpansion> train_expansion(const Samples& samples, const SvrHyperParameters& parameters);

// Returns for example `libsvm 3.24`.
std::string solver_name();

struct SvrChoice {
  SvrHyperParameters parameters;
  double rms = 0.0;                 // error of cross-validation, in normalised units
  std::size_t fold_count = 0;       // if 0, there were too few samples, and `parameters` are the defaults
  std::size_t candidate_count = 0;  // number of candidates, including unfinished ones
  std::size_t sample_count = 0;     // number of samples that the last stage used
};

// Searches hyper-parameters for `samples`, which are sorted by alpha, then specular, without duplicate
// inputs. If there are fewer than 8 samples, it does not search.
//
// It uses five folds, drawn by `seed` so that each fold covers every section of the table. If alpha is the
// only input, the first and the last sample are always training samples, because they bound the data. If a
// candidate's first two folds are much worse than the best, it is not finished. Among the candidates within
// one standard error of the best, the smallest gamma is chosen (one-standard-error rule, Breiman et al.
// 1984), because smoother mappings need smaller headers. The result does not depend on `jobs` (threads; 0:
// one per core), because decisions depend on counts and not on time, and results are combined in a fixed
// order.
//
// Throws kNumeric if no candidate converges, and the exceptions of `progress`.
SvrChoice search_hyper_parameters(const Samples& samples, std::uint64_t seed, unsigned jobs,
                                  const FitProgress& progress);

// Draws `count` of `samples`, or returns all if there are fewer. The list is cut into `count` equal sections,
// and `seed` chooses one sample of each section. So the sample covers a sorted list.
Samples draw_evenly(const Samples& samples, std::size_t count, std::uint64_t seed);

struct SvrOptions {
  std::uint64_t seed = 1;  // seed for the folds of the search and for drawing samples
  unsigned jobs = 0;       // threads; 0: one per core. The result does not depend on it
  // If hyper-parameters are missing, they are searched.
  std::optional<SvrHyperParameters> alpha, specular;
};

// Fits `rows` (all of status ok, finite). If alpha_needs_specular() returns false, target alpha is fitted
// from source alpha only. Rows with the same inputs are combined to one sample with their mean output. The
// published table has about twenty rows for each alpha1, and their mean target alpha gives the same fit in a
// hundredth of the time. Hyper-parameters are chosen by cross-validation within `rows`
// (search_hyper_parameters()). The model is then trained on all samples. If there are more than 2000, it is
// trained on 2000 samples, evenly drawn, which `method` records. Throws kInput for fewer than 10 rows or a
// constant input, and kUsage for hyper-parameters out of range. Throws kNumeric if libsvm does not converge
// with given hyper-parameters. If they were searched, C is reduced until it converges. libsvm then prints a
// warning to standard error, which cannot be disabled. An exception from `progress` ends the fit after the
// current trainings, within a few seconds.
//
// `method` has these entries for each output, with the prefix `alpha.` or `specular.`: C, gamma, epsilon,
// specular_span, alpha_pole, inputs, vectors, trained_samples. After a search, it also has folds, candidates,
// search_samples and cross_validation_rms (in the unit of the output).
Regression fit_svr(const std::vector<TableRow>& rows, const SvrOptions& options,
                   const FitProgress& progress = {});

}  // namespace remap
