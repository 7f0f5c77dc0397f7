#include "lower/limits.hpp"

#include <algorithm>
#include <array>

#include "core/number_text.hpp"

namespace remap {
namespace {

struct Count {
  std::size_t found, most;
  const char* what;
};

// Returns the first count beyond its limit.
template <std::size_t N>
std::string excess(const std::array<Count, N>& counts) {
  for (const Count& count : counts)
    if (count.found > count.most)
      return "has " + std::to_string(count.found) + " " + count.what + "; at most " +
             std::to_string(count.most) + " are possible";
  return "";
}

std::string first_of(const std::string& a, const std::string& b) { return a.empty() ? b : a; }

std::size_t longest(const std::vector<std::vector<double>>& rows) {
  std::size_t length = 0;
  for (const auto& row : rows) length = std::max(length, row.size());
  return length;
}

struct Oversize {
  std::string operator()(const Parametric& form) const {
    return excess(
        std::array{Count{form.alpha.size(), kMostSpecularPowers, "powers of specular in its roughness"},
                   Count{longest(form.alpha), kMostAlphaPowers, "powers of alpha in its roughness"},
                   Count{form.specular.size(), kMostTerms, "terms of specular"}});
  }
  std::string operator()(const Svr& svr) const {
    const std::size_t found = std::max(svr.alpha.count(), svr.specular.count());
    return excess(std::array{Count{found, kMostVectors, "support vectors"}});
  }
  std::string operator()(const Mlp& mlp) const {
    return first_of(oversize(mlp.alpha), oversize(mlp.specular));
  }
  std::string operator()(const CompactForm& form) const {
    std::size_t terms = 0;
    for (const FactorTerms* factor : {&form.alpha, &form.specular})
      for (const std::vector<float>& row : *factor) terms = std::max(terms, row.size());
    return excess(
        std::array{Count{std::max(form.alpha.size(), form.specular.size()), kMostPowersOfT, "powers of t"},
                   Count{terms, kMostPowersOfAlpha, "powers of alpha"}});
  }
};

std::string oversize(const Domain& domain) {
  const double largest = std::max(domain.alpha.max, domain.specular.max);
  return largest <= kLargestDomain ? ""
                                   : "has a domain to " + number_text(largest) + "; at most " +
                                         number_text(kLargestDomain) + " is possible";
}

}  // namespace

std::string oversize(const Network& network) {
  std::size_t numbers = 2 * (network.inputs.size() + network.outputs.size());
  for (const Layer& layer : network.layers) numbers += layer.weights.size() + layer.biases.size();
  return excess(std::array{Count{network.layers.size(), kMostLayers, "layers"},
                           Count{numbers, kMostNetworkNumbers, "numbers in a network"}});
}

std::string oversize(const Fit& fit) {
  return first_of(oversize(fit.domain), std::visit(Oversize{}, fit.mapping));
}

}  // namespace remap
