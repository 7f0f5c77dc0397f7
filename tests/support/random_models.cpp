#include "support/random_models.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "lower/form_fit.hpp"
#include "support/example_fit.hpp"

namespace remap {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  // Returns a value that is uniform in the logarithm.
  double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  bool chance(double share) { return between(0.0, 1.0) < share; }
  std::size_t count(std::size_t low, std::size_t high) {
    return std::min(high, low + static_cast<std::size_t>(between(0.0, static_cast<double>(high - low + 1))));
  }
  // Returns small counts more often than large ones.
  std::size_t few(std::size_t low, std::size_t high) {
    return static_cast<std::size_t>(magnitude(static_cast<double>(low), static_cast<double>(high) + 0.99));
  }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  // Returns sums of twelve uniform numbers: bell-shaped, the same on every machine.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += between(0.0, 1.0);
    return sum;
  }

 private:
  std::mt19937_64 engine_;
};

Domain random_domain(Random* random) {
  Domain domain;
  domain.alpha.min = random->chance(0.2) ? 1e-4 : random->magnitude(1e-3, 0.3);
  domain.alpha.max = random->chance(0.7) ? 1.0 : random->between(domain.alpha.min, 1.0);
  if (random->chance(0.1)) domain.alpha.max = domain.alpha.min * (1.0 + random->magnitude(1e-4, 0.1));
  domain.specular.max = random->chance(0.6) ? 1.0 : random->magnitude(0.02, 20.0);
  if (random->chance(0.1)) domain.specular.max = random->magnitude(1e-5, 1e-2);
  if (random->chance(0.3)) domain.specular.min = random->between(0.0, 0.9) * domain.specular.max;
  return domain;
}

AlphaCurve random_curve(Random* random, double wildness) {
  const auto rate = [&] {
    if (random->chance(0.1)) return 0.0;
    if (random->chance(0.1)) return random->magnitude(1e-12, 1e-3);
    return random->magnitude(0.01, 3000.0);
  };
  // phi is at most 1 / rate, so a factor that grows with the rate keeps the term relevant.
  const auto factor = [&](double of_rate) {
    return random->normal() * wildness * (random->chance(0.5) ? std::max(1.0, of_rate) : 1.0);
  };
  AlphaCurve curve;
  curve.start = random->normal() * wildness;
  if (random->chance(0.8)) {
    curve.ramp_rate = rate();
    curve.ramp = factor(curve.ramp_rate);
  }
  if (random->chance(0.5)) {
    curve.bump_rate = rate();
    curve.bump = factor(curve.bump_rate);
  }
  if (random->chance(0.2)) curve.pole = random->normal() * random->magnitude(1e-5, 0.1);
  return curve;
}

Parametric random_parametric(Random* random) {
  Parametric form;
  const std::size_t rows = random->chance(0.5) ? 1 : random->count(2, 5);
  const double wildness = random->chance(0.6) ? 1.0 : random->magnitude(1e-3, 1e4);
  for (std::size_t j = 0; j < rows; ++j) {
    std::vector<double> row;
    for (std::size_t i = random->count(1, 6); i-- > 0;) row.push_back(random->normal() * wildness);
    form.alpha.push_back(row);
  }
  const double wild_specular = random->chance(0.7) ? 1.0 : random->magnitude(1e-6, 1e4);
  if (random->chance(0.4)) {
    form.specular.push_back({1, random_curve(random, wild_specular)});
    return form;
  }
  for (int power = 0; power <= 3; ++power)
    for (double share = 0.5; random->chance(share); share *= 0.3)  // terms with equal powers are added
      form.specular.push_back({power, random_curve(random, wild_specular)});
  if (form.specular.empty()) form.specular.push_back({2, random_curve(random, wild_specular)});
  return form;
}

// Returns a scaling of an input over a range: about [0, 1], with or without a pole.
Scaling random_scaling(Random* random, const Range& range, bool may_have_pole) {
  Scaling scaling;
  if (may_have_pole && random->chance(0.5)) scaling.pole = random->magnitude(0.01, 1.0);
  const auto t = [&](double x) { return scaling.pole == 0.0 ? x : x / (x + scaling.pole); };
  scaling.offset = t(range.min);
  scaling.scale = random->magnitude(0.7, 1.5) / (t(range.max) - t(range.min));
  if (random->chance(0.1)) scaling.scale = -scaling.scale;
  return scaling;
}

std::vector<Scaling> random_inputs(Random* random, const Domain& domain, bool both) {
  std::vector<Scaling> inputs = {random_scaling(random, domain.alpha, true)};
  if (both) inputs.push_back(random_scaling(random, {0.0, domain.specular.max}, false));
  return inputs;
}

KernelExpansion random_expansion(Random* random, const Domain& domain, bool both) {
  KernelExpansion expansion;
  expansion.inputs = random_inputs(random, domain, both);
  expansion.gamma = random->magnitude(0.05, 50.0);
  expansion.bias = random->normal();
  const std::size_t count = random->few(1, 300);
  const double spread = random->chance(0.5) ? 0.0 : random->between(0.0, 3.0);  // decades
  double largest = 0.0;
  for (std::size_t v = 0; v < count; ++v) {
    for (std::size_t k = 0; k < expansion.inputs.size(); ++k)
      expansion.vectors.push_back(random->between(-0.2, 1.3));
    const double sign = v % 2 == 0 ? 1.0 : -1.0;
    expansion.weights.push_back(sign * random->between(0.1, 1.0) *
                                std::pow(10.0, random->between(-spread, spread)));
    largest = std::max(largest, std::fabs(expansion.weights.back()));
  }
  expansion.output.scale = largest * random->magnitude(1.0, 100.0);
  if (random->chance(0.1)) expansion.output.scale = random->magnitude(1e-4, 1e4);
  expansion.output.offset = random->between(-0.5, 0.5);
  return expansion;
}

Network random_network(Random* random, const Domain& domain, bool both, Activation activation) {
  Network network;
  network.activation = activation;
  network.inputs = random_inputs(random, domain, both);
  const double scale = random->magnitude(0.1, 10.0);
  std::size_t width = network.inputs.size();
  const auto add_layer = [&](std::size_t units) {
    Layer layer;
    layer.input_count = width;
    const double spread = scale / std::sqrt(static_cast<double>(width));
    for (std::size_t i = 0; i < units * width; ++i) layer.weights.push_back(random->normal() * spread);
    for (std::size_t i = 0; i < units; ++i) layer.biases.push_back(random->normal() * scale);
    network.layers.push_back(layer);
    width = units;
  };
  for (std::size_t hidden = random->count(0, 3); hidden-- > 0;) add_layer(random->few(1, 32));
  add_layer(1);
  network.outputs = {{random->between(-0.5, 0.5), random->magnitude(1.0, 10.0) * std::max(1.0, scale), 0.0}};
  return network;
}

MappingKind random_regressed(const std::string& kind, Random* random, const Domain& domain) {
  if (kind == "parametric") return random_parametric(random);
  const bool both = random->chance(0.3);  // true if target alpha depends on specular
  if (kind == "svr") {
    KernelExpansion alpha = random_expansion(random, domain, both);
    return Svr{alpha, random_expansion(random, domain, random->chance(0.9))};
  }
  const auto activation = static_cast<Activation>(random->count(0, 2));
  Network alpha = random_network(random, domain, both, activation);
  return Mlp{alpha, random_network(random, domain, random->chance(0.9), activation)};
}

// Returns a factor close to 1, with terms that get smaller.
FactorTerms random_factor(Random* random, bool is_long) {
  FactorTerms factor(is_long ? random->count(7, 8) : random->count(1, 5));
  for (std::size_t j = 0; j < factor.size(); ++j)
    for (std::size_t i = random->count(1, is_long ? 12 : 6); i-- > 0;)
      factor[j].push_back(static_cast<float>(0.3 * random->normal() / static_cast<double>(1 + i + j)));
  factor[0][0] = static_cast<float>(1.0 + 0.5 * random->normal());
  return factor;
}

}  // namespace

std::vector<std::string> random_kinds() { return {"parametric", "svr", "mlp"}; }

RandomModel random_model(const std::string& kind, std::uint64_t seed) {
  const std::vector<std::string> kinds = random_kinds();
  const auto number = std::find(kinds.begin(), kinds.end(), kind) - kinds.begin();
  Random random(seed * 3 + static_cast<std::uint64_t>(number));
  Domain domain = random_domain(&random);
  // Most of the mappings do not vanish with specular, so their domain must begin above 0.
  domain.specular.min = std::max(domain.specular.min, 0.02 * domain.specular.max);
  return {random_regressed(kind, &random, domain), domain};
}

std::optional<Fit> random_form_fit(std::uint64_t seed) {
  Random random(seed);
  Fit fit = example_fit();
  fit.id = "random_" + std::to_string(seed);
  fit.target.roughness = RoughnessEncoding::kAlpha;
  fit.domain = {{random.between(0.01, 0.21), 1.0}, {0.0, random.magnitude(0.3, 3.0)}};
  CompactForm form;
  form.pole = static_cast<float>(random.magnitude(0.03, 3.0));
  form.alpha = random_factor(&random, seed % 4 == 3);  // a long form uses loops instead of padded rows
  form.specular = random_factor(&random, seed % 4 == 3);
  const auto number = [&](double low, double high) { return static_cast<float>(random.between(low, high)); };
  if (seed % 3 != 0) form.specular_limit = number(0.2, 1.2);
  if (seed % 3 == 1) form.alpha_limit = number(0.5, 1.0);
  if (seed % 3 != 0) form.hinge = {number(-0.5, 0.5), number(-0.5, 0.5), number(0.0, 1.0), number(0.0, 1.0)};
  fit.mapping = form;
  return is_sound(form, fit.domain) ? std::optional(fit) : std::nullopt;
}

float factor_in_floats(const FactorTerms& factor, float alpha, float t) {
  float sum = 0.0f;
  for (std::size_t j = factor.size(); j-- > 0;) {
    float row = factor[j].back();
    for (std::size_t i = factor[j].size() - 1; i-- > 0;) row = row * alpha + factor[j][i];
    sum = j + 1 == factor.size() ? row : sum * t + row;
  }
  return sum;
}

}  // namespace remap
