#include <algorithm>

#include "core/number_text.hpp"
#include "lower/fit_file.hpp"

namespace remap {
namespace {

// Returns a complaint about a count beyond its limit, otherwise an empty text.
std::string excess(std::size_t found, std::size_t most, const std::string& what) {
  if (found <= most) return "";
  return "has " + std::to_string(found) + " " + what + "; at most " + std::to_string(most) + " are possible";
}

// Returns the first complaint.
std::string first_of(const std::string& a, const std::string& b) { return a.empty() ? b : a; }

std::size_t longest(const std::vector<std::vector<double>>& rows) {
  std::size_t length = 0;
  for (const auto& row : rows) length = std::max(length, row.size());
  return length;
}

std::string excess_of(const Parametric& form) {
  return first_of(excess(form.alpha.size(), kMostSpecularPowers, "powers of specular in its roughness"),
                  first_of(excess(longest(form.alpha), kMostAlphaPowers, "powers of alpha in its roughness"),
                           excess(form.specular.size(), kMostTerms, "terms of specular")));
}
std::string excess_of(const Svr& svr) {
  return excess(std::max(svr.alpha.count(), svr.specular.count()), kMostVectors, "support vectors");
}
std::string excess_of(const Mlp& mlp) { return first_of(oversize(mlp.alpha), oversize(mlp.specular)); }
std::string excess_of(const CompactForm& form) {
  std::size_t terms = 0;
  for (const FactorTerms* factor : {&form.alpha, &form.specular})
    for (const std::vector<float>& row : *factor) terms = std::max(terms, row.size());
  return first_of(excess(std::max(form.alpha.size(), form.specular.size()), kMostPowersOfT, "powers of t"),
                  excess(terms, kMostPowersOfAlpha, "powers of alpha"));
}

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
  return first_of(excess(network.layers.size(), kMostLayers, "layers"),
                  excess(numbers, kMostNetworkNumbers, "numbers in a network"));
}

std::string oversize(const Fit& fit) {
  return first_of(oversize(fit.domain),
                  std::visit([](const auto& kind) { return excess_of(kind); }, fit.mapping));
}

}  // namespace remap
