// How long users wait for the compiler's own work, on all cores.
#include "bench/bench.hpp"
#include "bench/sweep_table.hpp"
#include "fit/fit_table.hpp"
#include "lower/fit_file.hpp"

namespace remap_bench {
namespace {

// The table of headers.cpp; its models stand in its fits.
remap::Table made_table() {
  const remap::Fit fit = remap::load_fit(REMAP_BENCH_FOLDER "/svr.json");
  remap::Table table = remap::read_table(REMAP_BENCH_FOLDER "/table.csv");
  table.name = fit.table.name;
  table.source = fit.source;
  table.target = fit.target;
  return table;
}

void add_fit(std::string_view kind) {
  const remap::Table table = made_table();
  remap::FitOptions options;
  options.kind = kind;
  add_benchmark("fit " + std::string(kind), 1, 3,
                [table, options] { benchmark::DoNotOptimize(remap::fit_table(table, "", options)); });
}

void add_sweep(const char* name, const char* objective, const char* source, const char* target) {
  add_benchmark(name, 1, 3, [=] { benchmark::DoNotOptimize(sweep_table(objective, source, target)); });
}

}  // namespace

void add_fits() {
  add_fit("svr");
  add_fit("mlp");
  add_fit("parametric");
  add_sweep("sweep natural", "natural", "mitsuba/ward", "mitsuba/as");
  add_sweep("sweep paper", "paper", "mitsuba/ward", "mitsuba/as");
  add_sweep("sweep Schlick", "natural", "mitsuba/ggx", "mitsuba/beckmann");
}

Section fit_section(const Medians& medians) {
  const remap::Table table = made_table();
  const auto row = [&](const std::string& what, const std::string& name, std::optional<double> goal) {
    return Row{what, medians.seconds(name), "s", {}, "", goal, false};
  };
  return {"Compiler, all cores; fits of " + table.name + " (" + std::to_string(table.rows.size()) + " rows)",
          {row("fit: SVR with its search", "fit svr", 10.0), row("fit: MLP 2 x 8", "fit mlp", 20.0),
           row("fit: parametric, form chosen", "fit parametric", std::nullopt),
           row("sweep ward -> as, 30 x 30, 512^2, natural", "sweep natural", 10.0),
           row("the same, paper", "sweep paper", 10.0),
           row("sweep ggx -> beckmann (Schlick source), natural", "sweep Schlick", std::nullopt)}};
}

}  // namespace remap_bench
