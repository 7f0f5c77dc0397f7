// From a table of metallic materials and the specular ones whose pictures are the same to a network that
// leads back (Sztrajman et al. 2019, section 8).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fit/rows/regression.hpp"
#include "table/material_table.hpp"
#include "workflow/workflow_fit.hpp"

namespace remapc {

// The defaults are the network of the paper.
struct MaterialNetworkOptions {
  std::string id;                           // empty: `<specular model>_to_<metallic model>`
  std::vector<std::size_t> hidden = {300};  // units of each hidden layer
  remap::Activation activation = remap::Activation::kRelu;
  std::uint64_t seed = 1;          // of the split, of initial weights and of the validation rows
  std::size_t starts = 1;          // independent trainings, of which the best is kept
  double held_out_fraction = 0.1;  // of the rows, which judge the fit
  unsigned jobs = 0;               // threads; 0: one a processor. The fit does not depend on it
};

// How far a table is from equation (2): of F0 and diffuse over its rows, root mean squares.
struct FamilyDeviation {
  double dielectric_f0 = 0.0;  // that fits the rows best, to six digits
  double f0 = 0.0, diffuse = 0.0;
};

// Of a table of `remapc sample` from a metallic model (columns base_color_r1, ..., metallic1) to a specular
// one (f0_r2, ..., diffuse_r2, ...); rows of status ok. Throws kInput where it lacks columns or rows.
FamilyDeviation family_deviation(const MaterialTable& table);

// The way back through such a table, whose file is `bytes`. Diffuse is plain; widths are those of the table's
// models. Throws kInput as family_deviation does, where rows are further than 1e-3 from equation (2), and
// what train_network() throws; kUsage for an id that is no identifier and shares out of range.
remap::WorkflowFit fit_material_network(const MaterialTable& table, std::string_view bytes,
                                        const MaterialNetworkOptions& options,
                                        const FitProgress& progress = {});

}  // namespace remapc
