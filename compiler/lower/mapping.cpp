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

std::size_t count_of(const Parametric& form) {
  std::size_t count = 0;
  for (const auto& row : form.alpha) count += row.size();
  for (const SpecularTerm& term : form.specular) count += count_of(term.factor);
  return count;
}
std::size_t count_of(const Svr& svr) { return count_of(svr.alpha) + count_of(svr.specular); }
std::size_t count_of(const Mlp& mlp) { return count_of(mlp.alpha) + count_of(mlp.specular); }
std::size_t count_of(const CompactForm& form) { return number_count(form); }

const char* name_of(const Parametric&) { return "parametric"; }
const char* name_of(const Svr&) { return "svr"; }
const char* name_of(const Mlp&) { return "mlp"; }
const char* name_of(const CompactForm&) { return "compact"; }

bool alpha_needs_specular(const Parametric& form) { return form.alpha.size() > 1; }
bool alpha_needs_specular(const Svr& svr) { return svr.alpha.inputs.size() > 1; }
bool alpha_needs_specular(const Mlp& mlp) { return mlp.alpha.inputs.size() > 1; }
bool alpha_needs_specular(const CompactForm& form) { return form.alpha.size() > 1; }

bool scales_specular(const Parametric& form) {
  return std::ranges::all_of(form.specular, [](const SpecularTerm& term) { return term.power == 1; });
}
bool scales_specular(const Svr&) { return false; }
bool scales_specular(const Mlp&) { return false; }
bool scales_specular(const CompactForm& form) { return form.specular.size() == 1; }

}  // namespace

std::string kind_name(const MappingKind& mapping) {
  return std::visit([](const auto& kind) { return name_of(kind); }, mapping);
}

bool alpha_depends_on_specular(const MappingKind& mapping) {
  return std::visit([](const auto& kind) { return alpha_needs_specular(kind); }, mapping);
}

bool is_proportional(const MappingKind& mapping) {
  return std::visit([](const auto& kind) { return scales_specular(kind); }, mapping);
}

std::size_t number_count(const MappingKind& mapping) {
  return std::visit([](const auto& kind) { return count_of(kind); }, mapping);
}

}  // namespace remap
