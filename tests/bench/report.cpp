#include "bench/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace remap_bench {
namespace {

// Returns three digits, without an exponent.
std::string digits(double value) {
  char text[32];
  const int decimals =
      value <= 0.0 ? 0 : std::clamp(2 - static_cast<int>(std::floor(std::log10(value))), 0, 5);
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string goal_text(const Row& row) {
  if (!row.goal) return "";
  char text[32];
  std::snprintf(text, sizeof text, "goal %g", *row.goal);
  return text;
}

bool was_measured(const Row& row) { return row.value || row.ratio; }

std::string json_number(const std::optional<double>& value) { return value ? digits(*value) : "null"; }

}  // namespace

void Medians::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
    const auto items = run.counters.find("items_per_second");
    seconds_[run.run_name.function_name].push_back(items != run.counters.end() ? 1.0 / items->second.value
                                                                               : run.GetAdjustedRealTime());
  }
}

std::optional<double> Medians::seconds(const std::string& name) const {
  const auto found = seconds_.find(name);
  if (found == seconds_.end()) return std::nullopt;
  std::vector<double> values = found->second;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::optional<double> speed_ratio(const Medians& medians, const std::string& name, const std::string& rival) {
  const auto own = medians.seconds(name), other = medians.seconds(rival);
  if (!own || !other) return std::nullopt;
  return *other / *own;
}

std::optional<double> mega_items(const Medians& medians, const std::string& name) {
  const auto seconds = medians.seconds(name);
  if (!seconds) return std::nullopt;
  return 1e-6 / *seconds;
}

void print_text(const std::vector<Section>& sections) {
  for (const Section& section : sections) {
    if (std::none_of(section.rows.begin(), section.rows.end(), was_measured)) continue;
    std::printf("%s\n", section.title.c_str());
    for (const Row& row : section.rows) {
      if (!was_measured(row)) continue;
      const std::string value = row.value ? digits(*row.value) + " " + row.unit : "";
      const std::string ratio = row.ratio ? digits(*row.ratio) : "";
      std::printf("  %-52s %16s %9s %-26s %s\n", row.what.c_str(), value.c_str(), ratio.c_str(),
                  row.ratio ? ("of " + row.rival).c_str() : "", goal_text(row).c_str());
    }
    std::printf("\n");
  }
}

void print_json(const std::vector<Section>& sections) {
  const char* separator = "[";
  for (const Section& section : sections)
    for (const Row& row : section.rows) {
      if (!was_measured(row)) continue;
      std::printf("%s\n  {\"section\": \"%s\", \"what\": \"%s\", \"value\": %s, \"unit\": \"%s\", ",
                  separator, section.title.c_str(), row.what.c_str(), json_number(row.value).c_str(),
                  row.unit.c_str());
      std::printf("\"ratio\": %s, \"rival\": \"%s\", \"goal\": %s, \"goal_of\": \"%s\"}",
                  json_number(row.ratio).c_str(), row.rival.c_str(), json_number(row.goal).c_str(),
                  row.goal_is_ratio ? "ratio" : "value");
      separator = ",";
    }
  std::printf("\n]\n");
}

void add_benchmark(const std::string& name, std::size_t items, int repetitions, std::function<void()> run) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [items, run = std::move(run)](benchmark::State& state) {
                                 for (auto _ : state) {
                                   run();
                                   benchmark::ClobberMemory();
                                 }
                                 const auto runs = static_cast<std::int64_t>(state.iterations());
                                 state.SetItemsProcessed(runs * static_cast<std::int64_t>(items));
                               })
      ->Unit(benchmark::kSecond)
      ->Repetitions(repetitions)
      ->UseRealTime();
}

}  // namespace remap_bench
