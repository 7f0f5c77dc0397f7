// This file declares the benchmarks by subject. Each subject registers its runs, and afterwards makes its
// tables from their medians.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/report.hpp"

namespace remap_bench {

// A Maps holds planar maps of width (0.01 to 0.99) and RGB (0.002 to 0.2, inside the domain of every table),
// and maps for the results.
struct Maps {
  explicit Maps(std::size_t texels);
  std::size_t texels;
  std::array<std::vector<float>, 4> in, out;
};

void add_converters();
Section converter_section(const Medians& medians);

void add_maps();
Section maps_section(const Medians& medians);

void add_workflows();
Section workflow_section(const Medians& medians);

void add_warps();
Section warp_section(const Medians& medians);

void add_fits();
Section fit_section(const Medians& medians);

}  // namespace remap_bench
