// Makes what the benchmarks measure, in the build tree: the fits of one table, their headers, and networks of
// the size of Sztrajman et al. 2019, section 8. The table is the published one where it is at hand, otherwise
// one that the built-in renderer sweeps.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <random>
#include <string>

#include "bench/sweep_table.hpp"
#include "core/files.hpp"
#include "emit/emit.hpp"
#include "emit/mapping_code.hpp"
#include "fit/fit_table.hpp"
#include "lower/chain.hpp"
#include "lower/fit_file.hpp"
#include "lower/lower.hpp"
#include "support/shared_data.hpp"

namespace remap {

// Benchmarks go on without what a test would be skipped for.
void may_skip() {}

void skip(const std::string& what, const std::string& reason) { std::cerr << what << ": " << reason << "\n"; }

}  // namespace remap

namespace {

remap::Table bench_table() {
  // Where it is missing, this says so.
  const auto published = remap::shared_data("tables/mitsuba-ward2mitsuba-as.csv");
  if (!published.empty()) return remap::read_table(published, remap::column_map("sztrajman-2019"));
  remap::Table table = remap_bench::sweep_table("paper", "mitsuba/ward", "mitsuba/as");
  table.name = "built-in sweep";
  return table;
}

// `<name>.json`, and its header `<name>.hpp`.
void write_fit(const std::filesystem::path& folder, const remap::Table& table, const std::string& kind) {
  remap::FitOptions options;
  options.id = kind;
  options.kind = kind;
  options.regression.form = "paper";
  remap::Fit fit = remap::fit_table(table, remap::table_text(table), options).fit;
  add_converter(&fit);
  remap::write_file(folder / (kind + ".json"), fit_to_json(fit));
  remap::write_file(folder / (kind + ".hpp"), remap::emit_header(fit));
}

// Inputs and outputs in [0, 1], weights as a network starts with (Glorot and Bengio 2010): speed does not
// depend on them.
remap::Network random_network(remap::Activation activation) {
  std::mt19937 random(1);
  remap::Network network;
  network.activation = activation;
  network.inputs.assign(6, {0.5, 2.0, 0.0});
  network.outputs.assign(4, {0.5, 2.0, 0.0});
  std::size_t inputs = 6;
  for (const std::size_t units : {std::size_t{300}, std::size_t{4}}) {
    remap::Layer layer;
    layer.input_count = inputs;
    const double range = std::sqrt(6.0 / static_cast<double>(inputs + units));
    std::uniform_real_distribution<double> weight(-range, range);
    for (std::size_t i = 0; i < inputs * units; ++i) layer.weights.push_back(weight(random));
    for (std::size_t i = 0; i < units; ++i) layer.biases.push_back(weight(random));
    network.layers.push_back(layer);
    inputs = units;
  }
  return network;
}

// `network_<activation>.hpp`: the kernel of a network, with what the layout of a header has around it.
void write_network(const std::filesystem::path& folder, remap::Activation activation) {
  const remap::Network network = remap::folded(random_network(activation));
  const std::string name = "network_" + std::string(remap::activation_name(activation));
  remap::write_file(folder / (name + ".hpp"),
                    "#include <cstddef>\n#include <cstdint>\n#include <cstring>\n\nnamespace remap::" + name +
                        " {\n"
                        "inline std::uint32_t bits(float value) noexcept {\n"
                        "  std::uint32_t result = 0;\n"
                        "  std::memcpy(&result, &value, sizeof result);\n"
                        "  return result;\n}\n"
                        "inline float float_from_bits(std::uint32_t value) noexcept {\n"
                        "  float result = 0.0f;\n"
                        "  std::memcpy(&result, &value, sizeof result);\n"
                        "  return result;\n}\n"
                        "inline constexpr std::size_t kBlock = " +
                        std::to_string(remap::network_block(network)) + ";\n" +
                        remap::network_helpers(activation) + remap::network_function("rows", network) +
                        "}  // namespace remap::" + name + "\n");
}

// `fused.hpp`: three of the converters that ship as one pass.
void write_chain(const std::filesystem::path& folder) {
  const std::filesystem::path fits = std::filesystem::path(REMAP_SOURCE_DIR) / "fits";
  std::vector<remap::Fit> steps;
  for (const char* id : {"mitsuba_ward_to_mitsuba_ward_balanced", "mitsuba_ward_balanced_to_mitsuba_beckmann",
                         "mitsuba_beckmann_to_mitsuba_as"})
    steps.push_back(remap::load_fit(fits / (std::string(id) + ".json")));
  remap::Fit fused = remap::compose(steps, "fused");
  add_converter(&fused);
  remap::write_file(folder / "fused.hpp", remap::emit_header(fused));
}

}  // namespace

int main(int, char** argv) {
  try {
    const std::filesystem::path folder = argv[1];
    const remap::Table table = bench_table();
    remap::write_file(folder / "table.csv", remap::table_text(table));
    write_fit(folder, table, "svr");
    write_fit(folder, table, "parametric");
    write_fit(folder, table, "mlp");
    write_chain(folder);
    write_network(folder, remap::Activation::kRelu);
    write_network(folder, remap::Activation::kTanh);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
