#include "lower/mapping.hpp"

#include <algorithm>

namespace remap {
namespace {

std::size_t count_of(const Network& network) {
  std::size_t count = 2 * (network.inputs.size() + network.outputs.size());
  for (const Layer& layer : network.layers) count += layer.weights.size() + layer.biases.size();
  return count;
}

std::size_t count_of(const KernelExpansion& expansion) {
  return expansion.vectors.size() + expansion.weights.size() + 2 * expansion.inputs.size() + 4;
}

// Counts the constants of a curve. A missing term needs none.
std::size_t count_of(const AlphaCurve& curve) {
  std::size_t count = 1;
  if (curve.ramp != 0.0) count += 2;
  if (curve.bump != 0.0) count += 2;
  if (curve.pole != 0.0) count += 1;
  return count;
}

struct Name {
  std::string operator()(const Parametric&) const { return "parametric"; }
  std::string operator()(const Svr&) const { return "svr"; }
  std::string operator()(const Mlp&) const { return "mlp"; }
  std::string operator()(const CompactForm&) const { return "compact"; }
};

struct AlphaDependsOnSpecular {
  bool operator()(const Parametric& form) const { return form.alpha.size() > 1; }
  bool operator()(const Svr& svr) const { return svr.alpha.inputs.size() > 1; }
  bool operator()(const Mlp& mlp) const { return mlp.alpha.inputs.size() > 1; }
  bool operator()(const CompactForm& form) const { return form.alpha.size() > 1; }
};

struct IsProportional {
  bool operator()(const Parametric& form) const {
    return std::all_of(form.specular.begin(), form.specular.end(),
                       [](const SpecularTerm& term) { return term.power == 1; });
  }
  bool operator()(const Svr&) const { return false; }
  bool operator()(const Mlp&) const { return false; }
  bool operator()(const CompactForm& form) const { return form.specular.size() == 1; }
};

struct NumberCount {
  std::size_t operator()(const Parametric& form) const {
    std::size_t count = 0;
    for (const auto& row : form.alpha) count += row.size();
    for (const SpecularTerm& term : form.specular) count += count_of(term.factor);
    return count;
  }
  std::size_t operator()(const Svr& svr) const { return count_of(svr.alpha) + count_of(svr.specular); }
  std::size_t operator()(const Mlp& mlp) const { return count_of(mlp.alpha) + count_of(mlp.specular); }
  std::size_t operator()(const CompactForm& form) const { return remap::number_count(form); }
};

}  // namespace

std::string kind_name(const MappingKind& mapping) { return std::visit(Name{}, mapping); }

bool alpha_depends_on_specular(const MappingKind& mapping) {
  return std::visit(AlphaDependsOnSpecular{}, mapping);
}

bool is_proportional(const MappingKind& mapping) { return std::visit(IsProportional{}, mapping); }

std::size_t number_count(const MappingKind& mapping) { return std::visit(NumberCount{}, mapping); }

}  // namespace remap
