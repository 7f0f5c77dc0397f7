// This file measures how long users wait for the compiler's own work, on all cores.
#include "bench/bench.hpp"
#include "measure/sweep.hpp"

namespace remap_bench {
namespace {

// Returns a table of the built-in renderer, of the size that users sweep: 30 x 30 samples, pictures of 512^2.
remap::Table sweep_table(const std::string& objective, const std::string& source, const std::string& target) {
  const auto renderer = remap::make_builtin_renderer();
  remap::SweepOptions options;
  options.source = source;
  options.target = target;
  options.objective = remap::objective_preset(objective);
  options.sampling = "bench";
  options.samples = remap::grid_samples({0.01, 1.0}, 30, {0.0, 1.0}, 30);
  return remap::run_sweep(*renderer, options, {});
}

void add_sweep(const char* name, const char* objective, const char* source, const char* target) {
  add_benchmark(name, 1, 3, [=] { benchmark::DoNotOptimize(sweep_table(objective, source, target)); });
}

}  // namespace

void add_fits() {
  add_sweep("sweep natural", "natural", "mitsuba/ward", "mitsuba/as");
  add_sweep("sweep paper", "paper", "mitsuba/ward", "mitsuba/as");
  add_sweep("sweep Schlick", "natural", "mitsuba/ggx", "mitsuba/beckmann");
}

Section fit_section(const Medians& medians) {
  const auto row = [&](const std::string& what, const std::string& name, std::optional<double> goal) {
    return Row{what, medians.seconds(name), "s", {}, "", goal, false};
  };
  return {"Compiler, all cores",
          {row("sweep ward -> as, 30 x 30, 512^2, natural", "sweep natural", 10.0),
           row("the same, paper", "sweep paper", 10.0),
           row("sweep ggx -> beckmann (Schlick source), natural", "sweep Schlick", std::nullopt)}};
}

}  // namespace remap_bench
