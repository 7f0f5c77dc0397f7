// Trains a network from specular to metallic materials on a table of metallic materials and specular
// materials with the same pictures (Sztrajman et al. 2019, section 8).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fit/network/network_training.hpp"
#include "lower/workflow_fit.hpp"
#include "table/material_table.hpp"

namespace remap {

// The defaults describe the network of the paper.
struct MaterialNetworkOptions : TrainingOptions {
  MaterialNetworkOptions() {
    hidden = {300};
    activation = Activation::kRelu;
    starts = 1;
  }
  std::string id;                  // empty: `<specular model>_to_<metallic model>`
  double held_out_fraction = 0.1;  // share of the rows for the errors of the fit
};

// Trains the inverse of a table of `remapc sample` from a metallic model (columns base_color_r1, ...,
// metallic1) to a specular model (f0_r2, ..., diffuse_r2, ...). `bytes`: the file of the table. Only rows of
// status ok count. Diffuse is plain; the roughness conventions are those of the table's models. Throws kInput
// for missing columns, without rows, and if rows deviate from equation (2) by more than 1e-3 (RMS); kUsage
// for an invalid id or share; and the errors of train_network().
WorkflowFit fit_material_network(const MaterialTable& table, std::string_view bytes,
                                 const MaterialNetworkOptions& options, const FitProgress& progress = {});

}  // namespace remap
