// This file tests that Taylor models contain the functions that they enclose, on which every proof of
// lowering relies. The oracle is the same formula in long double, at points of random boxes.
#include "lower/taylor.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "lower/taylor.hpp"
#include "support/build_speed.hpp"
#include "support/exact_scalar.hpp"
#include "support/random_models.hpp"

using namespace remap;

namespace {

using OneTaylor = Taylor<1, 9>;
using TexelTaylor = Taylor<2, 7>;

constexpr int kBoxes = kSlowBuild ? 300 : 4000;
constexpr int kPointsInBox = 24;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  // Returns -1, 1, 0 or a number between: a place in a box.
  double place() {
    const double q = between(0.0, 1.0);
    return q < 0.1 ? -1.0 : q < 0.2 ? 1.0 : q < 0.25 ? 0.0 : between(-1.0, 1.0);
  }

 private:
  std::mt19937_64 engine_;
};

struct Box {
  double centre = 0.0, half = 0.0;
  Exact at(double place) const {
    return {static_cast<long double>(centre) +
            static_cast<long double>(half) * static_cast<long double>(place)};
  }
};

// Returns a box of any width, from a point to a box that reaches down to 0. Centres are from 1e-4 to 1, like
// alphas.
Box random_box(Random* random) {
  Box box;
  box.centre = random->magnitude(1e-4, 1.0);
  box.half = random->between(0.0, 1.0) < 0.05 ? 0.0 : box.centre * random->magnitude(1e-9, 1.0);
  return box;
}

template <int N>
long double polynomial_at(const Taylor<1, N>& taylor, long double u, long double) {
  long double sum = 0.0L;
  for (int i = N; i >= 0; --i) sum = sum * u + static_cast<long double>(taylor.at(i, 0));
  return sum;
}
template <int N>
long double polynomial_at(const Taylor<2, N>& taylor, long double u, long double v) {
  long double sum = 0.0L;
  for (int i = 0; i <= N; ++i)
    for (int j = 0; i + j <= N; ++j)
      sum += static_cast<long double>(taylor.at(i, j)) * std::pow(u, i) * std::pow(v, j);
  return sum;
}

// Claims counts the enclosures with a finite bound, and among them those whose remainder is at most a
// millionth of the bound.
struct Claims {
  int made = 0, close = 0;
};

// Long double has rounding errors, too: 1e-17 of the terms of a sum.
template <typename T>
bool contains(const T& enclosure, long double u, long double v, Exact expected) {
  const auto slack = 1e-17L * static_cast<long double>(enclosure.bound());
  return std::fabs(polynomial_at(enclosure, u, v) - expected.value) <=
         static_cast<long double>(enclosure.rest()) + slack;
}

template <typename T>
void count(const T& enclosure, Claims* claims) {
  if (!std::isfinite(enclosure.bound())) return;
  ++claims->made;
  if (enclosure.rest() <= 1e-6 * enclosure.bound()) ++claims->close;
}

// `function` accepts any scalar.
template <typename Function>
void check_of_one(const Box& box, Random* random, Claims* claims, const Function& function) {
  const OneTaylor enclosure = function(OneTaylor::variable(0, box.centre, box.half));
  count(enclosure, claims);
  if (!std::isfinite(enclosure.bound())) return;
  for (int i = 0; i < kPointsInBox; ++i) {
    const double u = random->place();
    if (contains(enclosure, static_cast<long double>(u), 0.0L, function(box.at(u)))) continue;
    FAIL_CHECK("box " << box.centre << " +- " << box.half << " at " << u << " rest " << enclosure.rest());
    return;
  }
}

template <typename Function>
void check_of_two(const Box& first, const Box& second, Random* random, Claims* claims,
                  const Function& function) {
  const TexelTaylor enclosure = function(TexelTaylor::variable(0, first.centre, first.half),
                                         TexelTaylor::variable(1, second.centre, second.half));
  count(enclosure, claims);
  if (!std::isfinite(enclosure.bound())) return;
  for (int i = 0; i < kPointsInBox; ++i) {
    const double u = random->place(), v = random->place();
    if (contains(enclosure, static_cast<long double>(u), static_cast<long double>(v),
                 function(first.at(u), second.at(v))))
      continue;
    FAIL_CHECK("box " << first.centre << " +- " << first.half << ", " << second.centre << " +- "
                      << second.half << " at " << u << ", " << v << " rest " << enclosure.rest());
    return;
  }
}

}  // namespace

TEST_CASE("taylor: elementary functions lie within their enclosures") {
  Random random(1);
  Claims claims;
  for (int i = 0; i < kBoxes; ++i) {
    const Box box = random_box(&random);
    const double q = random.between(0.0, 1.0);
    const double rate = q < 0.05  ? 0.0
                        : q < 0.2 ? random.magnitude(1e-13, 1e-6)
                                  : random.magnitude(1e-3, 1e5);
    const double factor = random.magnitude(1e-3, 1e3) * (q < 0.5 ? 1.0 : -1.0);
    const double shift = random.between(-2.0, 2.0) * std::fabs(factor) * box.centre;
    const double pole = random.magnitude(1e-6, 1.0);
    INFO("rate " << rate << " factor " << factor << " shift " << shift << " pole " << pole);
    check_of_one(box, &random, &claims, [&](const auto& x) { return rise(rate, x); });
    check_of_one(box, &random, &claims, [&](const auto& x) { return rise(rate, x * x) * factor; });
    check_of_one(box, &random, &claims, [&](const auto& x) { return reciprocal(x); });
    check_of_one(box, &random, &claims, [&](const auto& x) { return reciprocal(x + pole) * -pole + 1.0; });
    check_of_one(box, &random, &claims,
                 [&](const auto& x) { return hyperbolic_tangent(x * factor + shift); });
    check_of_one(box, &random, &claims, [&](const auto& x) { return rectified(x * factor + shift); });
    check_of_one(box, &random, &claims,
                 [&](const auto& x) { return activated(Activation::kSilu, x * factor + shift); });
  }
  CHECK(claims.made > 6 * kBoxes);
  CHECK(claims.close > 4 * kBoxes);
}

TEST_CASE("taylor: products and sums of two variables lie within their enclosures") {
  Random random(2);
  Claims claims;
  for (int i = 0; i < kBoxes / 2; ++i) {
    const Box first = random_box(&random), second = random_box(&random);
    const double a = random.between(-5.0, 5.0), b = random.magnitude(1e-8, 1e8);
    check_of_two(first, second, &random, &claims, [&](const auto& x, const auto& y) {
      const auto z = (x * a + y) * (y * b - 1.0) - x * y * b;
      return z * z * (x + 0.5) - z * (y * y * y);
    });
    check_of_two(first, second, &random, &claims, [&](const auto& x, const auto& y) {
      return hyperbolic_tangent(x * a + y) * reciprocal(x + y) + rise(std::fabs(a), x * y);
    });
  }
  CHECK(claims.made > kBoxes * 3 / 4);
  CHECK(claims.close > kBoxes / 4);
}

TEST_CASE("taylor: sums of Gaussians lie within their enclosures") {
  Random random(3);
  Claims claims;
  for (int i = 0; i < kBoxes / 2; ++i) {
    KernelExpansion expansion;
    expansion.gamma = random.magnitude(0.01, 1e4);
    const bool two = random.between(0.0, 1.0) < 0.5;
    const double spread = random.between(0.0, 12.0);
    for (int v = 0; v < 6; ++v) {
      expansion.weights.push_back((v % 2 == 0 ? 1.0 : -1.0) *
                                  std::pow(10.0, random.between(-spread, spread)));
      for (int k = 0; k < (two ? 2 : 1); ++k) expansion.vectors.push_back(random.between(-0.5, 1.5));
    }
    const Box first = random_box(&random), second = random_box(&random);
    INFO("gamma " << expansion.gamma << " spread " << spread);
    if (two)
      check_of_two(first, second, &random, &claims, [&](const auto& x, const auto& y) {
        return gaussian_sum(expansion, std::vector{x, y});
      });
    else
      check_of_one(first, &random, &claims,
                   [&](const auto& x) { return gaussian_sum(expansion, std::vector{x}); });
  }
  CHECK(claims.made > kBoxes / 4);
  CHECK(claims.close > kBoxes / 10);
}

TEST_CASE("taylor: whole models lie within their enclosures") {
  Random random(4);
  for (const std::string& kind : random_kinds()) {
    Claims claims;
    const int models = kBoxes / 20;
    for (int seed = 0; seed < models; ++seed) {
      INFO(kind << " " << seed);
      const RandomModel model = random_model(kind, static_cast<std::uint64_t>(1000 + seed));
      const auto inside = [&](const Range& range) {
        const double half = 0.5 * (range.max - range.min) * random.magnitude(1e-5, 1.0);
        return Box{random.between(range.min + half, range.max - half), half};
      };
      const Box alpha = inside(model.domain.alpha), specular = inside(model.domain.specular);
      std::visit(
          [&](const auto& mapping) {
            check_of_two(alpha, specular, &random, &claims,
                         [&](const auto& a, const auto& s) { return target_specular(mapping, a, s); });
            check_of_two(alpha, specular, &random, &claims,
                         [&](const auto& a, const auto& s) { return target_alpha(mapping, a, s); });
          },
          model.mapping);
    }
    INFO(kind);
    CHECK(claims.made > models);
    CHECK(claims.close > models / 2);
  }
}

TEST_CASE("taylor: what has no bound claims none") {
  const OneTaylor around_zero = OneTaylor::variable(0, 0.1, 0.2);
  CHECK_FALSE(std::isfinite(reciprocal(around_zero).bound()));
  // No function may hide NaN and infinity.
  for (const double wide : {1e308, std::numeric_limits<double>::infinity()}) {
    const OneTaylor x = OneTaylor::variable(0, 0.5, 0.25) * wide * 1e10;
    CHECK_FALSE(std::isfinite(x.bound()));
    CHECK_FALSE(std::isfinite((x * x).bound()));
    CHECK_FALSE(std::isfinite((x - x).bound()));
    CHECK_FALSE(std::isfinite(rise(1.0, x).bound()));
    CHECK_FALSE(std::isfinite(reciprocal(x).bound()));
    const KernelExpansion expansion{{}, {}, 1.0, 0.0, {0.5}, {1.0}};
    CHECK_FALSE(std::isfinite(gaussian_sum(expansion, std::vector{x}).bound()));
  }
}
