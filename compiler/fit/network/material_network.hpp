// This file trains a network that converts specular to metallic materials. Its table has pairs of a metallic
// and a specular material with the same pictures (Sztrajman et al. 2019, section 8).
#pragma once

#include <string>
#include <string_view>

#include "fit/network/network_training.hpp"
#include "lower/fit_file.hpp"
#include "table/table.hpp"

namespace remap {

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
