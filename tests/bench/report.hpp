// This file keeps the results of the benchmarks, and prints tables of them.
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

  // Returns the seconds for an item: a texel, or one run if no items were counted. Returns nothing for a
  // benchmark that did not run.
  std::optional<double> seconds(const std::string& name) const;

 private:
  std::map<std::string, std::vector<double>> seconds_;
};

// A Row is one line of a table. Values that were not measured stay empty and are not printed.
struct Row {
  std::string what;
  std::optional<double> value;
  std::string unit;  // unit of `value`
  std::optional<double> ratio;
  std::string rival;  // the program or code that `ratio` compares with
  std::optional<double> goal = std::nullopt;
  bool goal_is_ratio = true;  // if false, `goal` is an upper limit of `value`
};

struct Section {
  std::string title;
  std::vector<Row> rows;
};

// Returns how many times as fast as `rival` the benchmark `name` is, item for item.
std::optional<double> speed_ratio(const Medians& medians, const std::string& name, const std::string& rival);

// Returns millions of items per second.
std::optional<double> mega_items(const Medians& medians, const std::string& name);

void print_text(const std::vector<Section>& sections);
void print_json(const std::vector<Section>& sections);

// Registers a benchmark of `items` items per run. The median is over `repetitions`, which run in random order
// with all other benchmarks.
void add_benchmark(const std::string& name, std::size_t items, int repetitions, std::function<void()> run);

}  // namespace remap_bench
