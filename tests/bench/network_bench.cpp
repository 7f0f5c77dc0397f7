// This file measures the header of a network of 6 x 300 x 4 (Sztrajman et al. 2019, section 8) against
// Eigen's products of such matrices, which omit biases and activations.
#include <random>

#include "bench/bench.hpp"
#include "bench/builds.hpp"

namespace remap_bench {
namespace {

constexpr std::size_t kTexels = 4096;

std::vector<float> random_floats(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0.01f, 0.99f);
  std::vector<float> values(count);
  for (float& value : values) value = share(random);
  return values;
}

struct Rows {
  std::vector<float> in = random_floats(6 * kTexels), out = std::vector<float>(4 * kTexels, 1.0f);
  std::vector<float> hidden_weights = random_floats(6 * 300), output_weights = random_floats(300 * 4);
};

Rows& rows() {
  static Rows rows;
  return rows;
}

constexpr std::size_t kBatches[] = {64, 128, 256, 512};

std::string products_name(const std::string& flags, std::size_t batch, bool texels_innermost) {
  return "eigen_" + flags + "/" + std::to_string(batch) + (texels_innermost ? "/columns" : "/rows");
}

// Returns the batch and layout that are fastest with Eigen.
std::string best_products(const Medians& medians, const std::string& flags) {
  std::string best = products_name(flags, kBatches[0], true);
  for (const std::size_t batch : kBatches)
    for (const bool innermost : {true, false}) {
      const std::string name = products_name(flags, batch, innermost);
      const auto seconds = medians.seconds(name);
      if (seconds && *seconds < medians.seconds(best).value_or(1e300)) best = name;
    }
  return best;
}

}  // namespace

void add_networks() {
  for (const Build<ProductsPass>& build : products_builds())
    for (const std::size_t batch : kBatches)
      for (const bool innermost : {true, false}) {
        const ProductsPass pass = build.function;
        add_benchmark(products_name(build.flags, batch, innermost), kTexels, 5, [pass, batch, innermost] {
          Rows& r = rows();
          pass({batch, innermost, r.hidden_weights.data(), r.output_weights.data()}, kTexels, r.in.data(),
               r.out.data());
        });
      }
}

Section network_section(const Medians& medians) {
  Section section{"The network of 6 x 300 x 4 against Eigen's products (GEMM) at the same flags, one core",
                  {}};
  const auto add = [&](const std::string& what, const std::string& name, const std::string& flags) {
    const std::string rival = best_products(medians, flags);
    section.rows.push_back({what + " at " + flags_text(flags), mega_items(medians, name), "Mtexel/s",
                            speed_ratio(medians, name, rival),
                            "Eigen, batches of " + rival.substr(rival.find('/') + 1),
                            flags != "o3" ? std::optional(0.8) : std::nullopt});
  };
  for (const Build<MaterialPass>& build : material_builds())
    if (build.code == kNetworkHeader && build.flags != "o2")
      add("the header of whole materials", build.code + "_" + build.flags + "/small", build.flags);
  return section;
}

}  // namespace remap_bench
