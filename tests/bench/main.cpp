// This program measures what the tools and their generated code cost, as ratios to rivals in the same run. It
// never passes or fails. scripts/bench runs it. `--json` prints the tables as JSON. Other arguments belong to
// Google Benchmark, such as --benchmark_filter=data.
#include <cstring>
#include <string>
#include <vector>

#include "bench/bench.hpp"

int main(int argc, char** argv) {
  using namespace remap_bench;
  bool json = false;
  std::vector<std::string> arguments = {argv[0], "--benchmark_enable_random_interleaving=true"};
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0)
      json = true;
    else
      arguments.push_back(argv[i]);
  }
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;

  add_converters();
  add_maps();
  add_workflows();
  add_warps();
  add_fits();
  Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  const std::vector<Section> sections = {converter_section(medians), maps_section(medians),
                                         workflow_section(medians), warp_section(medians),
                                         fit_section(medians)};
  if (json)
    print_json(sections);
  else
    print_text(sections);
  return 0;
}
