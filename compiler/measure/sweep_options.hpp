// This file holds the options of a sweep: what it computes, and how it runs.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "lower/mapping.hpp"
#include "measure/objective.hpp"
#include "measure/parameter_roles.hpp"
#include "measure/probe.hpp"

namespace remap {

// A PairOptions holds two models, and how their pictures are compared.
struct PairOptions {
  std::string source;
  std::string target;
  ParameterRoles source_roles, target_roles;
  Objective objective;
  int resolution = 512;
  int samples_per_axis = 1;
  bool match_irradiance = true;
  bool accept_light = false;  // continue even if require_light() (table/light.hpp) would throw
};

// A SweepOptions holds the settings of a sweep. Every field is recorded in the table's comments.
struct SweepOptions : PairOptions {
  std::string sampling;              // how the samples were chosen, in words
  std::vector<MappedTexel> samples;  // in the order of the table; specular canonical (probe.hpp)
  int stages = 2;                    // 1, 2 or 3 (section 3.1)
  double diffuse = 0.0;              // diffuse of the source in every sample
};

// A SweepExecution decides how a sweep runs. None of this changes the table.
struct SweepExecution {
  unsigned jobs = 0;                                                // 0: one for each core
  std::function<void(std::size_t done, std::size_t all)> progress;  // called from any thread
  const std::atomic<bool>* cancelled = nullptr;  // checked between rows; throws kInterrupted
};

}  // namespace remap
