// What the benchmarks gave, and the tables that are printed of it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace remap_bench {

// Keeps the median of each benchmark's repetitions.
class Medians final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override;

  // Seconds an item (a texel, or one run where no items were counted); none for what did not run.
  std::optional<double> seconds(const std::string& name) const;

 private:
  std::map<std::string, std::vector<double>> seconds_;
};

// One line of a table. What was not measured stays empty and is not printed.
struct Row {
  std::string what;
  std::optional<double> value;
  std::string unit;  // of value
  std::optional<double> ratio;
  std::string rival;  // ratio is of what
  std::optional<double> goal = std::nullopt;
  bool goal_is_ratio = true;  // otherwise of value, which should not exceed it
};

struct Section {
  std::string title;
  std::vector<Row> rows;
};

// How much faster `name` is than `rival`, an item for an item.
std::optional<double> speed_ratio(const Medians& medians, const std::string& name, const std::string& rival);

// Millions of items a second.
std::optional<double> mega_items(const Medians& medians, const std::string& name);

void print_text(const std::vector<Section>& sections);
void print_json(const std::vector<Section>& sections);

// Registers a benchmark of `items` items a run; medians are of `repetitions`, taken in random order with all
// others.
void add_benchmark(const std::string& name, std::size_t items, int repetitions, std::function<void()> run);

}  // namespace remap_bench
