// Lowering where models and domains are at their worst: tiny domains, kinks, steep flanks, cancellation,
// overflow.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <catch2/catch.hpp>

#include "lower/evaluate.hpp"
#include "lower/lower.hpp"
#include "lower/prove.hpp"
#include "remap/error.hpp"
#include "support/campaign.hpp"
#include "support/exact_scalar.hpp"
#include "support/random_models.hpp"

using namespace remap;

namespace {

constexpr Domain kWhole{{1e-4, 1.0}, {0.0, 1.0}};

// On a dense grid of floats, against long double: the interpreter's own rounding must not blur an edge.
void check_bounds(const MappingKind& mapping, const Domain& domain, const Lowered& lowered) {
  constexpr int kAlphas = 700, kSpeculars = 13;
  double alpha_share = 0.0, specular_share = 0.0;
  const auto at = [](double low, double high, int i, int count) {
    const double q = static_cast<double>(i) / count;
    return std::clamp(static_cast<float>(low + (high - low) * q * q), static_cast<float>(low),
                      static_cast<float>(high));
  };
  const auto include = [](double* share, const LoweredFunction& function, float a, float s, Exact expected) {
    const long double found = static_cast<long double>(value(function.polynomial, a, s));
    const double error = static_cast<double>(std::fabs(found - expected.value)) / function.bound;
    *share = std::max(*share, std::isnan(error) ? INFINITY : error);
  };
  for (int i = 0; i <= kAlphas; ++i)
    for (int j = 0; j <= kSpeculars; ++j) {
      const float a = at(domain.alpha.min, domain.alpha.max, i, kAlphas);
      const float s = at(0.0, domain.specular.max, j, kSpeculars);
      const Exact alpha{static_cast<long double>(a)}, specular{static_cast<long double>(s)};
      std::visit(
          [&](const auto& kind) {
            include(&alpha_share, lowered.alpha, a, s, target_alpha(kind, alpha, specular));
            include(&specular_share, lowered.specular, a, s, target_specular(kind, alpha, specular));
          },
          mapping);
    }
  CHECK(alpha_share <= 1.0);
  CHECK(specular_share <= 1.0);
}

// Empty where it was refused; a refusal is of the right kind and names a bound, or says that there is none.
std::optional<Lowered> lower_or_refuse(const MappingKind& mapping, const Domain& domain,
                                       const LoweringOptions& options = {}) {
  try {
    const Lowered lowered = lower(mapping, domain, options);
    check_bounds(mapping, domain, lowered);
    return lowered;
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::kNumeric);
    CHECK_THAT(error.what(),
               Catch::Contains(" is not finite") ||
                   (Catch::Contains(" numbers to stay within ") &&
                    (Catch::Contains(" can be proven") || Catch::Contains("no bound can be proven"))));
    return std::nullopt;
  }
}

Parametric line() { return {{{1.0}}, {{1, {0.8, 0.0, 0.0, 0.0, 0.0, 0.0}}}}; }

Svr one_gaussian(double gamma, double centre, double weight) {
  KernelExpansion expansion;
  expansion.inputs = {{}};
  expansion.gamma = gamma;
  expansion.vectors = {centre};
  expansion.weights = {weight};
  KernelExpansion of_both = expansion;
  of_both.inputs = {{}, {}};
  of_both.vectors = {centre, 0.4};
  return {expansion, of_both};
}

Network kink(double at, double slope) {
  return {Activation::kRelu, {{}}, {{}}, {{1, {slope}, {-slope * at}}, {1, {1.0}, {0.1}}}};
}

}  // namespace

// One model of each kind a domain, and four in a full campaign.
TEST_CASE("lowering: random models over the edges of domains", "[slow][campaign]") {
  const std::vector<Domain> domains = {
      kWhole,
      {{0.5, 0.500001}, {0.0, 1.0}},  // some floats wide
      {{0.999, 1.0}, {0.3, 0.4}},     // specular does not begin at 0
      {{1e-4, 2e-4}, {0.0, 1e-6}},    // tiny in both
      {{0.01, 1.0}, {0.0, 1000.0}},   // specular far beyond 1
      {{1e-6, 1.0}, {0.999999, 1.0}},
  };
  int met = 0, tried = 0;
  for (std::size_t d = 0; d < domains.size(); ++d)
    for (const std::string& kind : random_kinds())
      for (std::uint64_t seed = 500; seed < 504; ++seed) {
        if (!is_full_campaign() && seed != 500 + d % 4) continue;
        const Domain& domain = domains[d];
        INFO(kind << " " << seed << " alpha " << domain.alpha.min << " " << domain.alpha.max << " specular "
                  << domain.specular.max);
        ++tried;
        met += lower_or_refuse(random_model(kind, seed).mapping, domain, {1e-3, 1e-3}) ? 1 : 0;
      }
  CHECK(met >= tried / 2);
}

TEST_CASE("lowering: a straight line keeps float precision") {
  const Lowered lowered = lower(line(), kWhole);
  check_bounds(line(), kWhole, lowered);
  CHECK(lowered.alpha.polynomial.cell_count == 1);
  CHECK(lowered.alpha.rises_with_alpha);
  CHECK(lowered.specular.rises_with_specular);
  CHECK(lowered.alpha.bound <= 1e-5);
}

TEST_CASE("lowering: nothing is lowered to nothing") {
  const Parametric zero{{{0.0}}, {{1, {}}}};
  const Lowered lowered = lower(zero, kWhole);
  CHECK(value(lowered.alpha.polynomial, 0.5f, 0.5f) == 0.0f);
  CHECK(value(lowered.specular.polynomial, 0.5f, 0.5f) == 0.0f);
}

TEST_CASE("lowering: rates from next to nothing to far beyond the domain") {
  for (const double rate : {1e-300, 1e-12, 1e-3, 1.0, 80.0, 3e3, 1e5, 1e9, 1e300}) {
    INFO("rate " << rate);
    Parametric form = line();
    form.specular = {{0, {0.1, 0.5 * std::max(1.0, rate), rate, 0.0, 0.0, 0.0}},
                     {1, {0.2, 0.0, 0.0, 0.3 * std::max(1.0, rate), rate, 0.0}}};
    const auto lowered = lower_or_refuse(form, kWhole);
    if (rate < 100.0) CHECK(lowered.has_value());
  }
}

TEST_CASE("lowering: a pole next to the domain") {
  for (const double first : {1e-6, 1e-4, 1e-2}) {
    Parametric form = line();
    form.specular = {{1, {0.5, 0.0, 0.0, 0.0, 0.0, 0.02}}};
    INFO("domain from " << first);
    const auto lowered = lower_or_refuse(form, {{first, 1.0}, {0.0, 1.0}});
    if (first >= 1e-2) CHECK(lowered.has_value());
  }
  Parametric at_zero = line();
  at_zero.specular = {{1, {0.5, 0.0, 0.0, 0.0, 0.0, 0.02}}};
  CHECK_FALSE(lower_or_refuse(at_zero, {{0.0, 1.0}, {0.0, 1.0}}).has_value());
}

TEST_CASE("lowering: Gaussians from flat to narrower than a cell", "[slow]") {
  for (const double gamma : {1e-9, 0.05, 5.0, 50.0, 1e3, 1e5, 1e8, 1e300})
    for (const double centre : {-3.0, 0.3337, 0.99999}) {
      INFO("gamma " << gamma << " centre " << centre);
      const auto lowered = lower_or_refuse(one_gaussian(gamma, centre, 0.7), kWhole);
      if (gamma <= 5.0 && centre > 0.0) CHECK(lowered.has_value());
    }
}

TEST_CASE("lowering: a spike between the samples is seen by the proof") {
  // 1e-5 wide: the grid of samples, ten times coarser at least, sees next to nothing of it.
  const Svr spike = one_gaussian(1e10, 0.41234567, 0.7);
  const auto lowered = lower_or_refuse(spike, kWhole);
  if (lowered) CHECK(lowered->alpha.bound >= 0.3);
}

TEST_CASE("lowering: large weights that cancel") {
  for (const double weight : {1e3, 1e6, 1e9, 1e12, 1e300}) {
    Svr svr = one_gaussian(2.0, 0.3, weight);
    svr.alpha.vectors.push_back(0.3 + 0.1 / weight);
    svr.alpha.weights.push_back(-weight);
    svr.specular = one_gaussian(2.0, 0.3, 1.0).specular;
    INFO("weight " << weight);
    const auto lowered = lower_or_refuse(svr, kWhole);
    if (weight <= 1e6) CHECK(lowered.has_value());
  }
}

TEST_CASE("lowering: a kink anywhere") {
  for (const double at : {0.5, 0.31234, 1e-4, 1.0, 2.0})
    for (const double slope : {1e-3, 1.0, 100.0}) {
      INFO("kink at " << at << " slope " << slope);
      const auto lowered = lower_or_refuse(Mlp{kink(at, slope), kink(at, slope)}, kWhole, {0.1, 0.1});
      CHECK((lowered.has_value() || slope > 1.0));
    }
}

TEST_CASE("lowering: what overflows is refused") {
  const double huge = 1e308;
  CHECK_FALSE(lower_or_refuse(one_gaussian(1.0, 0.5, huge), kWhole).has_value());
  Parametric form = line();
  form.alpha = {{huge, huge, -huge}};
  CHECK_FALSE(lower_or_refuse(form, kWhole).has_value());
  CHECK_FALSE(lower_or_refuse(Mlp{kink(0.5, huge), kink(0.5, huge)}, kWhole).has_value());
}

TEST_CASE("proof: a polynomial that is changed after the fact is caught") {
  const Svr svr = one_gaussian(5.0, 0.4, 0.7);
  const Lowered lowered = lower(svr, kWhole);
  const MappedFunction model =
      mapped_function(false, [svr](const auto& a, const auto& s) { return target_alpha(svr, a, s); });
  const ProofDomain domain{kWhole.alpha, kWhole.specular};
  const auto bound_of = [&](const PiecewisePolynomial& polynomial) {
    return proven_error(model, polynomial, domain, lowered.alpha.bound, 4000).bound;
  };
  CHECK(bound_of(lowered.alpha.polynomial) <= lowered.alpha.bound);
  for (std::size_t i = 0; i < lowered.alpha.polynomial.coefficients.size(); ++i) {
    PiecewisePolynomial changed = lowered.alpha.polynomial;
    float& coefficient = changed.coefficients[i];
    coefficient += 1e-2f * std::max(std::fabs(coefficient), 1.0f);
    CHECK(bound_of(changed) > lowered.alpha.bound);
  }
}

TEST_CASE("rounding: a fall of the polynomial is not proven to rise") {
  PiecewisePolynomial polynomial;
  polynomial.degrees = {3};
  polynomial.coefficients = {0.0f, 0.10f, -0.5f, 1.0f};  // falls between 0.16 and 0.17 only for 0.08 and less
  const ProofDomain domain{kWhole.alpha, kWhole.specular};
  CHECK(proven_rising_with_alpha(polynomial, domain));
  polynomial.coefficients[1] = 0.08f;
  CHECK_FALSE(proven_rising_with_alpha(polynomial, domain));
}
