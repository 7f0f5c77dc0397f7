// Imports support vector regressions that were trained by other programs: libsvm model files and a
// description of their inputs and outputs.
#pragma once

#include <filesystem>

#include "remap/fit.hpp"

namespace remapc {

// Builds a fit from a description (JSON):
//
//   {
//     "id": "my_ward_to_as",                                (optional; default: <source>_to_<target>)
//     "source": {"model": "mitsuba/ward", "roughness": "alpha", "specular": "specular"},
//     "target": {"model": "mitsuba/as", "roughness": "alpha", "specular": "f0"},
//     "domain": {"alpha": [0.02, 1], "specular": [0, 0.25]},
//     "alpha": {"model_file": "alpha.model",                (in the folder of the description)
//               "inputs": [{"name": "alpha", "offset": 0.02, "scale": 1.0204}],
//               "output": {"offset": 0, "scale": 1}},
//     "specular": {"model_file": "specular.model",
//                  "inputs": [{"name": "alpha", "offset": 0.02, "scale": 1.0204},
//                             {"name": "specular", "offset": 0, "scale": 4}],
//                  "output": {"offset": 0, "scale": 1}}
//   }
//
// `inputs` are in the order of the indices in the model file: alpha (the microfacet width, whatever the
// parameters of the models are), specular (linear), or both in either order. Scalings are normalised = (value
// - offset) * scale; use offset 0 and scale 1 for values that were not normalised. For column k of a fitted
// scaler of scikit-learn:
//   MinMaxScaler:    scale = scale_[k],     offset = -min_[k] / scale_[k] (data_min_[k] for the range 0 to 1)
//   StandardScaler:  scale = 1 / scale_[k], offset = mean_[k]
//
// The errors and the row counts of the fit are 0, because no table is known; `method` states it (key
// `imported`). Throws kInput with the file and the place in it for a file that cannot be read or is not JSON,
// and for a missing, unknown or invalid field; and the errors of expansion_from_svm_model().
remap::Fit import_svr(const std::filesystem::path& description);

}  // namespace remapc
