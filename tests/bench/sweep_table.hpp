// A table of the built-in renderer, as users sweep it: 30 x 30 samples, pictures of 512^2.
#pragma once

#include <string>

#include "measure/sweep.hpp"

namespace remap_bench {

inline remap::Table sweep_table(const std::string& objective, const std::string& source,
                                const std::string& target) {
  const auto renderer = remap::make_builtin_renderer();
  remap::SweepOptions options;
  options.source = source;
  options.target = target;
  options.objective = remap::objective_preset(objective);
  options.sampling = "bench";
  options.samples = remap::grid_samples({0.01, 1.0}, 30, {0.0, 1.0}, 30);
  return remap::run_sweep(*renderer, options, {});
}

}  // namespace remap_bench
