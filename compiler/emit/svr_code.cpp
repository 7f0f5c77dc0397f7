// Sums of Gaussians as fitted: loops over the vectors, in double precision, since large weights cancel.
#include <algorithm>
#include <cmath>

#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remapc {
namespace {

using remap::KernelExpansion;
using remap::Scaling;

// exp(-x) of doubles holds down to 2^-1000.
constexpr double kLargestExponent = 690.0;

constexpr std::string_view kHelpers = R"(
inline std::uint64_t double_bits(double value) noexcept {
  std::uint64_t result = 0;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

inline double double_from_bits(std::uint64_t value) noexcept {
  double result = 0.0;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

// exp(-x) for 0 <= x <= 690, relative error below 1e-13: 2^n times the series of 2^f, f in [-1/2, 1/2].
inline double exp_of_minus(double x) noexcept {
  const double t = x * -1.4426950408889634;
  const std::int32_t n = static_cast<std::int32_t>(t - 0.5);
  const double f = t - static_cast<double>(n);
  double p = 4.4455382718708101e-10;
  p = p * f + 7.0549116208011225e-09;
  p = p * f + 1.0178086009239699e-07;
  p = p * f + 1.3215486790144305e-06;
  p = p * f + 1.5252733804059841e-05;
  p = p * f + 1.5403530393381608e-04;
  p = p * f + 1.3333558146428443e-03;
  p = p * f + 9.6181291076284769e-03;
  p = p * f + 5.5504108664821580e-02;
  p = p * f + 2.4022650695910071e-01;
  p = p * f + 6.9314718055994531e-01;
  p = p * f + 1.0;
  const std::uint64_t exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(n)) << 52;
  return double_from_bits(double_bits(p) + exponent);
}
)";

constexpr std::string_view kExpansion = R"(
// Weight and vector of each Gaussian.
inline constexpr double @table@[@count@][@width@] = {
    @rows@
};

inline void @name@(std::size_t count, const float* alpha, const float* specular, float* out) noexcept {
  double x[kBlock], y[kBlock], sum[kBlock];
  for (std::size_t i = 0; i < count; ++i) {
    const double a = static_cast<double>(alpha[i]), s = static_cast<double>(specular[i]);
    x[i] = @x@;
    y[i] = @y@;
    sum[i] = @bias@;
  }
  for (const auto& gaussian : @table@) {
    for (std::size_t i = 0; i < count; ++i) {
      const double dx = x[i] - gaussian[1], dy = y[i] - @vector_y@;
      const double dx_2 = dx * dx, square = dy * dy + dx_2;
      double value = exp_of_minus(square * @gamma@);
      @squarings@
      sum[i] = value * gaussian[0] + sum[i];
    }
  }
  for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(sum[i] * @range@ + @offset@);
}
)";

std::string normalised_text(const Scaling& scaling, const std::string& value) {
  const std::string t =
      scaling.pole == 0.0 ? value : value + " / (" + value + " + " + double_literal(scaling.pole) + ")";
  return "(" + t + " - " + double_literal(scaling.offset) + ") * " + double_literal(scaling.scale);
}

double normalised(const Scaling& scaling, double value) {
  const double t = scaling.pole == 0.0 ? value : value / (value + scaling.pole);
  return (t - scaling.offset) * scaling.scale;
}

// The largest exponent gamma |x - v|^2 over the domain.
double largest_exponent(const KernelExpansion& expansion, const remap::Domain& domain) {
  double largest = 0.0;
  const std::size_t width = expansion.inputs.size();
  for (std::size_t v = 0; v < expansion.count(); ++v) {
    double square = 0.0;
    for (std::size_t k = 0; k < width; ++k) {
      const remap::Range& range = k == 0 ? domain.alpha : domain.specular;
      double far = 0.0;
      for (const double end : {range.min, range.max})
        far =
            std::max(far, std::fabs(normalised(expansion.inputs[k], end) - expansion.vectors[v * width + k]));
      square += far * far;
    }
    largest = std::max(largest, expansion.gamma * square);
  }
  return largest;
}

std::string rows_function(const std::string& name, const std::string& table, const KernelExpansion& expansion,
                          const remap::Domain& domain) {
  const std::size_t width = expansion.inputs.size();
  std::string rows;
  for (std::size_t v = 0; v < expansion.count(); ++v) {
    rows += "{" + double_literal(expansion.weights[v]);
    for (std::size_t k = 0; k < width; ++k) rows += ", " + double_literal(expansion.vectors[v * width + k]);
    rows += "},\n";
  }
  if (expansion.count() == 0) rows = "{0.0, 0.0" + std::string(width == 2 ? ", 0.0" : "") + "},\n";
  // exp(-x) as exp(-x / 2^k) squared k times, where x would leave the range of the exponential.
  int squarings = 0;
  double gamma = expansion.gamma;
  for (double largest = largest_exponent(expansion, domain); largest > kLargestExponent;
       largest *= 0.5, ++squarings)
    gamma *= 0.5;
  std::string squaring_text;
  for (int i = 0; i < squarings; ++i) squaring_text += "value = value * value;\n";
  const bool two = width == 2;
  return fill_template(kExpansion, {{"table", table},
                                    {"count", std::to_string(std::max<std::size_t>(1, expansion.count()))},
                                    {"width", std::to_string(width + 1)},
                                    {"rows", rows},
                                    {"name", name},
                                    {"x", normalised_text(expansion.inputs[0], "a")},
                                    {"y", two ? normalised_text(expansion.inputs[1], "s") : "s * 0.0"},
                                    {"vector_y", two ? "gaussian[2]" : "0.0"},
                                    {"bias", double_literal(expansion.bias)},
                                    {"gamma", double_literal(gamma)},
                                    {"squarings", squaring_text},
                                    {"range", double_literal(1.0 / expansion.output.scale)},
                                    {"offset", double_literal(expansion.output.offset)}});
}

// What double precision leaves: 1e-13 of the weights for the exponential and the sum; what normalising the
// inputs loses where a domain is narrow, by the steepest slope of a Gaussian, sqrt(2 gamma / e).
double error_of(const KernelExpansion& expansion, const remap::Domain& domain) {
  constexpr double kSvrUnit = 2.3e-16;
  double weights = 0.0, moved = 0.0;
  for (const double weight : expansion.weights) weights += std::fabs(weight);
  for (std::size_t k = 0; k < expansion.inputs.size(); ++k) {
    const Scaling& scaling = expansion.inputs[k];
    const double largest = scaling.pole > 0.0 ? 1.0 : (k == 0 ? domain.alpha.max : domain.specular.max);
    moved += 6.0 * kSvrUnit * (largest + std::fabs(scaling.offset)) * std::fabs(scaling.scale);
  }
  const double of_sum = weights * (4e-13 + 0.86 * std::sqrt(expansion.gamma) * moved);
  return (of_sum + 8.0 * kSvrUnit * std::fabs(expansion.bias)) / std::fabs(expansion.output.scale) +
         8.0 * kSvrUnit * std::fabs(expansion.output.offset);
}

}  // namespace

MappingCode exact_code(const remap::Svr& svr, const remap::Domain& domain) {
  MappingCode code;
  code.form = CodeForm::kRows;
  code.description = "As fitted: sums over " + std::to_string(svr.alpha.count()) + " and " +
                     std::to_string(svr.specular.count()) +
                     " support vectors, in double precision, by an exponential of its own (1e-13).";
  code.functions = std::string(kHelpers) +
                   rows_function("target_alpha_rows", "kAlphaGaussians", svr.alpha, domain) +
                   rows_function("target_specular_rows", "kSpecularGaussians", svr.specular, domain);
  code.alpha_error = error_of(svr.alpha, domain);
  code.specular_error = error_of(svr.specular, domain);
  return code;
}

}  // namespace remapc
