// This file fits the small networks of sections 5.1 and 8 (Sztrajman et al. 2019), one for each output.
#pragma once

#include <vector>

#include "fit/network/network_training.hpp"

namespace remap {

// Fits `rows` (all of status ok, finite) with alpha and specular as inputs. If alpha_needs_specular() returns
// false, target alpha is fitted from source alpha only. Some of `rows`, drawn at random, are validation rows,
// which determine when the training ends. `method` has RMS errors in units of alpha and specular: over
// the training rows, and over the validation rows before the last iterations, which train on them, too.
// Throws kInput for fewer than 10 rows or a constant input, kUsage for a layer without units, kNumeric if no
// start converges, and the exceptions of `progress`.
Regression fit_mlp(const std::vector<TableRow>& rows, const TrainingOptions& options,
                   const FitProgress& progress = {});

}  // namespace remap
