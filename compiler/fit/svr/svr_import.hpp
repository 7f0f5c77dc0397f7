// Support vector regressions that were trained elsewhere: libsvm model files, and a description of what goes
// in and comes out.
#pragma once

#include <filesystem>

#include "model/fit.hpp"

namespace remapc {

// The fit that a description (JSON) puts together:
//
//   {
//     "id": "my_ward_to_as",                                (may be missing: <source>_to_<target>)
//     "source": {"model": "mitsuba/ward", "roughness": "alpha", "specular": "specular"},
//     "target": {"model": "mitsuba/as", "roughness": "alpha", "specular": "f0"},
//     "domain": {"alpha": [0.02, 1], "specular": [0, 0.25]},
//     "alpha": {"model_file": "alpha.model",                (beside the description)
//               "inputs": [{"name": "alpha", "offset": 0.02, "scale": 1.0204}],
//               "output": {"offset": 0, "scale": 1}},
//     "specular": {"model_file": "specular.model",
//                  "inputs": [{"name": "alpha", "offset": 0.02, "scale": 1.0204},
//                             {"name": "specular", "offset": 0, "scale": 4}],
//                  "output": {"offset": 0, "scale": 1}}
//   }
//
// `inputs` are in the order of the model's indices: alpha (the microfacet width, whatever the models' own
// parameters are), specular (linear), or both in either order. Both scalings mean
// normalised = (value - offset) * scale; offset 0 and scale 1 for what was not normalised. From scikit-learn,
// of a fitted scaler's column k:
//   MinMaxScaler:    scale = scale_[k],     offset = -min_[k] / scale_[k] (data_min_[k] for the range 0 to 1)
//   StandardScaler:  scale = 1 / scale_[k], offset = mean_[k]
//
// Errors of the fit are 0, as are its rows: nothing is known of how well it follows a table. `method` says so
// (key `imported`). Throws kInput, naming the file and where in it, for a file that cannot be read, is no
// JSON, or misses a field, has an unknown or wrong one, and what expansion_from_svm_model() throws.
remap::Fit import_svr(const std::filesystem::path& description);

}  // namespace remapc
