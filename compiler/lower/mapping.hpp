// This file lists the kinds of mapping that a fit can hold: target alpha and target specular as functions of
// source alpha (remap/model.hpp) and source specular. Specular is mapped channel by channel. If target alpha
// depends on specular, the largest channel decides, because it is the visible highlight.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "converter/compact_form.hpp"
#include "reference/network.hpp"

namespace remap {

// An AlphaCurve is a curve over alpha (Sztrajman et al. 2019, section 7):
//   start + ramp phi(ramp_rate, alpha) + bump phi(bump_rate, alpha^2) + pole / alpha,
//   phi(rate, x) = (1 - exp(-rate x)) / rate, which is x where the rate is 0.
//
// This is the paper's c0 + c1 exp(-c2 alpha) + c3 exp(-c4 alpha^2) with c1 = -ramp / ramp_rate, c2 =
// ramp_rate, c3 = -bump / bump_rate, c4 = bump_rate, c0 = start - c1 - c3. In this form, slow exponentials
// remain sums of numbers of order one. With c2 -> 0 the published coefficients reach -512.13 + 512.75
// exp(-0.00057 alpha). `pole` is the c5 of the authors' scripts. Its term is finite because a domain starts
// above alpha 0 and the domain rule clamps alpha to it.
struct AlphaCurve {
  double start = 0.0;
  double ramp = 0.0;
  double ramp_rate = 0.0;  // >= 0
  double bump = 0.0;
  double bump_rate = 0.0;  // >= 0
  double pole = 0.0;
  bool operator==(const AlphaCurve&) const = default;
};

// A SpecularTerm is one term of a sum over powers of specular1: factor(alpha1) specular1^power.
struct SpecularTerm {
  int power = 1;  // 0: offset (the rim of a target with Fresnel); 1: the paper's slope; 2: curvature
  AlphaCurve factor;
  bool operator==(const SpecularTerm&) const = default;
};

// Parametric is a kind: alpha2 = sum over j, i of alpha[j][i] specular1^j alpha1^(i+1), specular2 = the sum
// of the terms. The form of the paper has one row of four in `alpha` and one term of power 1.
struct Parametric {
  std::vector<std::vector<double>> alpha;
  std::vector<SpecularTerm> specular;  // powers never decrease; terms with equal powers are added
  bool operator==(const Parametric&) const = default;
};

// A KernelExpansion is a sum of Gaussians, the result of support vector regression (Chang and Lin 2011,
// equation 10). Its normalised output is bias + sum of weights[i] exp(-gamma |x - vector i|^2), where x are
// the normalised inputs.
struct KernelExpansion {
  std::vector<Scaling> inputs;  // 1: alpha; 2: alpha, specular
  Scaling output;
  double gamma = 1.0;  // > 0
  double bias = 0.0;
  std::vector<double> vectors;  // normalised; rows of inputs.size() numbers
  std::vector<double> weights;  // one per vector
  std::size_t count() const noexcept { return weights.size(); }
  bool operator==(const KernelExpansion&) const = default;
};

// Svr is the kind `svr`, with one expansion per output.
struct Svr {
  KernelExpansion alpha;
  KernelExpansion specular;
  bool operator==(const Svr&) const = default;
};

// Mlp is the kind `mlp`, with one network per output. Its inputs are alpha, or alpha and specular.
struct Mlp {
  Network alpha;
  Network specular;
  bool operator==(const Mlp&) const = default;
};

// A new kind of mapping is added here, and std::visit makes every caller handle it. CompactForm is the kind
// `compact`, which converters have. All other kinds are lowered to it.
using MappingKind = std::variant<CompactForm, Parametric, Svr, Mlp>;

// Returns the name in JSON, on the command line and on model cards.
std::string kind_name(const MappingKind& mapping);

bool alpha_depends_on_specular(const MappingKind& mapping);

// Returns true if target specular is a function of alpha times specular. Channels are then independent.
bool is_proportional(const MappingKind& mapping);

// A MappedTexel holds the two parameters of a texel with one channel, or the distance of two such texels.
struct MappedTexel {
  double alpha = 0.0;
  double specular = 0.0;
};

// Returns the number of coefficients, a measure of complexity when kinds are compared.
std::size_t number_count(const MappingKind& mapping);

}  // namespace remap
