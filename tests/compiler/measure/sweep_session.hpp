// This file holds what the tests of sweeps share: the renderer, options with defaults, and a sweep.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "measure/sweep.hpp"

namespace remap {

inline const Renderer& builtin_renderer() {
  static const std::unique_ptr<Renderer> renderer = make_builtin_renderer();
  return *renderer;
}

inline SweepOptions sweep_options(const std::string& source, const std::string& target,
                                  const std::string& objective, std::vector<MappedTexel> samples,
                                  int resolution = 512) {
  SweepOptions options;
  options.source = source;
  options.target = target;
  options.objective = objective_preset(objective);
  options.resolution = resolution;
  options.sampling = "test";
  options.samples = std::move(samples);
  return options;
}

inline Table sweep(const Renderer& renderer, const SweepOptions& options, unsigned jobs = 0) {
  SweepExecution execution;
  execution.jobs = jobs;
  return run_sweep(renderer, options, execution);
}

// Returns the value of a comment of a table, or an empty text if there is no such comment.
inline std::string comment(const Table& table, const std::string& key) {
  for (const auto& [name, value] : table.comments)
    if (name == key) return value;
  return "";
}

}  // namespace remap
