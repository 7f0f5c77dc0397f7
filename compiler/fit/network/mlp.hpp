// This file fits the small networks of sections 5.1 and 8 (Sztrajman et al. 2019), one for each output.
#pragma once

#include <vector>

#include "fit/network/network_training.hpp"

namespace remap {

using MlpOptions = TrainingOptions;

// Fits `rows` (all of status ok, finite) with alpha and specular as inputs. Target alpha is fitted only from
// source alpha unless alpha_needs_specular(). Validation rows drawn from `rows` determine when the training
// stops. The figures in `method` are RMS errors in units of alpha and specular, over the training rows and
// over the validation rows before they joined the training. Throws kInput for fewer than 10 rows or a
// constant input, kUsage for a layer without units, kNumeric if no start converges, and the exceptions of
// `progress`.
Regression fit_mlp(const std::vector<TableRow>& rows, const MlpOptions& options,
                   const FitProgress& progress = {});

}  // namespace remap
