// The small network of sections 5.1 and 8 (Sztrajman et al. 2019), one for each output of a texel.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/rows/regression.hpp"

namespace remapc {

// The defaults are those of TrainingOptions (network_training.hpp).
struct MlpOptions {
  std::vector<std::size_t> hidden = {8, 8};  // units of each hidden layer
  remap::Activation activation = remap::Activation::kTanh;
  std::uint64_t seed = 1;  // of initial weights and of the validation rows
  std::size_t starts = 4;  // independent trainings, of which the best on the validation rows is kept
  unsigned jobs = 0;       // threads; 0: one a processor. The result does not depend on it
};

// Fits `rows` (all of status ok, finite) with raw alpha and specular as inputs. Roughness is regressed from
// roughness alone unless alpha_needs_specular(). Training stops by validation rows drawn from `rows`; the
// figures in `method` are root mean squares in units of alpha and specular, over the rows that trained and
// over the validation rows before they joined the training. Throws kInput for fewer than 10 rows or where an
// input is constant, kUsage for a layer without units, kNumeric where no start converges, and what
// `progress` throws.
Regression fit_mlp(const std::vector<TableRow>& rows, const MlpOptions& options,
                   const FitProgress& progress = {});

}  // namespace remapc
