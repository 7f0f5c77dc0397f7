// What the tools cost, as ratios to a rival in the same run: the converter pass against a memcpy of the same
// four channels, and the times of sweep and fit. Never passes or fails; scripts/bench runs it.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/pass.hpp"
#include "fit/fit_table.hpp"
#include "sweep/sweep.hpp"

namespace {

constexpr std::size_t kTexels = 4096 * 4096;

// Four planar channels in and out, 4096^2 texels: far beyond every cache.
struct Maps {
  std::array<std::vector<float>, 4> in, out;
  Maps() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> share(0.01f, 0.99f);
    for (auto& row : in) {
      row.resize(kTexels);
      for (float& value : row) value = share(random);
    }
    for (auto& row : out) row.assign(kTexels, 1.0f);
  }
};

Maps& maps() {
  static Maps maps;
  return maps;
}

void copy_maps(benchmark::State& state) {
  Maps& m = maps();
  for (auto _ : state) {
    for (std::size_t c = 0; c < 4; ++c) std::memcpy(m.out[c].data(), m.in[c].data(), kTexels * sizeof(float));
    benchmark::ClobberMemory();
  }
}

void run_pass(benchmark::State& state, remap_bench::Pass pass) {
  Maps& m = maps();
  for (auto _ : state) {
    benchmark::DoNotOptimize(pass(kTexels, m.in[0].data(), {m.in[1].data(), m.in[2].data(), m.in[3].data()},
                                  m.out[0].data(), {m.out[1].data(), m.out[2].data(), m.out[3].data()}));
    benchmark::ClobberMemory();
  }
}

remapc::Table sweep_table(const std::string& objective, const std::string& source,
                          const std::string& target) {
  const auto renderer = remapc::make_builtin_renderer();
  const remapc::SweepOptions options{source,
                                     target,
                                     remapc::objective_preset(objective),
                                     objective,
                                     512,
                                     1,
                                     "bench",
                                     remapc::grid_samples({0.01, 1.0}, 30, {0.0, 1.0}, 30)};
  const auto journal = std::filesystem::temp_directory_path() / "remap-bench.journal";
  remapc::Table table = remapc::run_sweep(*renderer, options, {}, journal, false);
  std::filesystem::remove(journal);
  return table;
}

void run_sweep(benchmark::State& state, const char* objective, const char* source, const char* target) {
  for (auto _ : state) benchmark::DoNotOptimize(sweep_table(objective, source, target));
}

void run_fit(benchmark::State& state) {
  remapc::Table table = sweep_table("paper", "mitsuba/ward", "mitsuba/as");
  const std::string bytes = remapc::table_text(table);
  for (auto _ : state) benchmark::DoNotOptimize(remapc::fit_table(table, bytes, {}));
}

// Keeps the median of each benchmark's repetitions.
class Medians final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration)
        seconds_[run.run_name.function_name].push_back(run.GetAdjustedRealTime());
  }
  double median(const std::string& name) {
    auto& values = seconds_.at(name);
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }

 private:
  std::map<std::string, std::vector<double>> seconds_;
};

void print_pass(Medians& medians, const std::string& name, const char* text, const char* goal) {
  const double copy = medians.median("memcpy"), pass = medians.median(name);
  std::printf("  %-44s %6.0f Mtexel/s   %.2f of memcpy   (goal %s)\n", text, kTexels / pass / 1e6,
              copy / pass, goal);
}

}  // namespace

int main(int, char** argv) {
  std::vector<std::string> arguments = {argv[0], "--benchmark_enable_random_interleaving=true"};
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());

  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const auto repeat = [](benchmark::internal::Benchmark* b, int times) {
    b->Unit(benchmark::kSecond)->Repetitions(times)->UseRealTime();
  };
  repeat(benchmark::RegisterBenchmark("memcpy", copy_maps), 15);
  repeat(benchmark::RegisterBenchmark("pass O2", run_pass, remap_bench::pass_o2), 15);
  repeat(benchmark::RegisterBenchmark("pass O3", run_pass, remap_bench::pass_o3), 15);
  if (avx2) repeat(benchmark::RegisterBenchmark("pass AVX2", run_pass, remap_bench::pass_avx2), 15);
  repeat(benchmark::RegisterBenchmark("fit", run_fit), 5);
  repeat(benchmark::RegisterBenchmark("sweep natural", run_sweep, "natural", "mitsuba/ward", "mitsuba/as"),
         3);
  repeat(benchmark::RegisterBenchmark("sweep paper", run_sweep, "paper", "mitsuba/ward", "mitsuba/as"), 3);
  repeat(
      benchmark::RegisterBenchmark("sweep Schlick", run_sweep, "natural", "mitsuba/ggx", "mitsuba/beckmann"),
      3);

  Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  std::printf("Converter pass, roughness + RGB, 4096 x 4096 texels, one core (medians of 15)\n");
  std::printf("  %-44s %6.0f Mtexel/s\n", "memcpy of the same four channels",
              kTexels / medians.median("memcpy") / 1e6);
  if (avx2) print_pass(medians, "pass AVX2", "header at -O3 -march=x86-64-v3 (AVX2, FMA)", "0.9");
  print_pass(medians, "pass O3", "header at plain -O3", "0.5");
  print_pass(medians, "pass O2", "header at plain -O2", "none");
  std::printf("Compiler, all cores\n");
  std::printf("  %-44s %6.2f s   (goal 10)\n", "sweep ward -> as, 30 x 30, 512^2, natural",
              medians.median("sweep natural"));
  std::printf("  %-44s %6.2f s   (goal 10)\n", "the same, paper", medians.median("sweep paper"));
  std::printf("  %-44s %6.2f s\n", "sweep ggx -> beckmann (Schlick source), natural",
              medians.median("sweep Schlick"));
  std::printf("  %-44s %6.1f ms  (goal 50)\n", "parametric fit of such a table", 1e3 * medians.median("fit"));
  return 0;
}
