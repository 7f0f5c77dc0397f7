#include "lower/prove.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "converter/emitted_order.hpp"

namespace remap {
namespace {

constexpr std::size_t kRisingBudget = 4000;      // boxes that the proof of rising may examine
constexpr double kFloatUnit = 1.0 / 16777216.0;  // unit roundoff of a float, 2^-24
constexpr double kSmallest = 1.2e-38;            // above the smallest normal float: the loss by underflow

// A box within one cell.
struct Box {
  Range alpha, specular;
  int cell = 0;
  int alpha_halvings = 0, specular_halvings = 0;
};

double centre(const Range& range) { return 0.5 * (range.min + range.max); }
double half_width(const Range& range) { return 0.5 * (range.max - range.min); }

// The result of an enclosure over a box.
struct Verdict {
  double bound = 0.0;           // infinite if the enclosure failed
  double at_least = -INFINITY;  // no bound can be lower
  bool halve_alpha = true;      // the direction in which to halve the box
};

// NaN would be lost in comparisons.
double claimed(double bound) { return std::isnan(bound) ? INFINITY : bound; }

// `centre`: the bounded value in the middle of the box.
template <int Variables, int Order>
Verdict verdict(const Taylor<Variables, Order>& function, double centre, double bound, const Box& box,
                bool of_specular) {
  const double at_least = centre - function.rest();
  if (!of_specular) return {claimed(bound), at_least, true};
  // If the remainder dominates the polynomial, both directions in turn.
  const double alpha = function.extent(0), specular = function.extent(Variables - 1);
  const bool tells = std::isfinite(bound) && std::max(alpha, specular) > 0.01 * function.rest();
  return {claimed(bound), at_least, tells ? alpha >= specular : box.alpha_halvings <= box.specular_halvings};
}

struct Judged {
  Verdict verdict;
  Box box;
  bool operator<(const Judged& other) const { return verdict.bound < other.verdict.bound; }
};

// The part of the domain in which a cell is used. The first and the last cell extend to the ends of the
// domain.
Range alpha_of_cell(const PiecewisePolynomial& polynomial, const ProofDomain& domain, int cell) {
  const auto clamped = [&](double alpha) { return std::clamp(alpha, domain.alpha.min, domain.alpha.max); };
  return {cell == 0 ? domain.alpha.min : clamped(cell_begin(polynomial, cell)),
          cell + 1 == polynomial.cell_count ? domain.alpha.max : clamped(cell_begin(polynomial, cell + 1))};
}

// Initial boxes in the part of the domain of each cell.
std::vector<Box> first_boxes(const PiecewisePolynomial& polynomial, const ProofDomain& domain,
                             bool of_specular) {
  const int cells = polynomial.cell_count;
  const int in_alpha = std::max(1, 16 / cells), in_specular = of_specular ? 2 : 1;
  std::vector<Box> boxes;
  for (int cell = 0; cell < cells; ++cell) {
    const auto [from, to] = alpha_of_cell(polynomial, domain, cell);
    for (int i = 0; i < in_alpha; ++i)
      for (int j = 0; j < in_specular; ++j) {
        // Quadratic spacing, because curves bend most near alpha 0.
        const auto part = [&, begin = from, end = to](int k) {
          return k == in_alpha ? end : begin + (end - begin) * k * k / (in_alpha * in_alpha);
        };
        const double width = domain.specular.max - domain.specular.min;
        boxes.push_back({{part(i), part(i + 1)},
                         {domain.specular.min + width * j / in_specular,
                          domain.specular.min + width * (j + 1) / in_specular},
                         cell,
                         0,
                         0});
      }
  }
  return boxes;
}

std::array<Box, 2> halves(const Box& box, bool halve_alpha) {
  Box low = box, high = box;
  if (halve_alpha) {
    low.alpha.max = high.alpha.min = centre(box.alpha);
    low.alpha_halvings = ++high.alpha_halvings;
  } else {
    low.specular.max = high.specular.min = centre(box.specular);
    low.specular_halvings = ++high.specular_halvings;
  }
  return {low, high};
}

// Halves the worst box until the worst bound is at most `target`, the budget is spent, or the target turns
// out to be unreachable.
template <typename Judge>
Proof refine(const std::vector<Box>& boxes, double target, std::size_t budget, const Judge& judge) {
  std::priority_queue<Judged> queue;
  double at_least = -INFINITY;
  const auto look_at = [&](const Box& box) {
    const Verdict verdict = judge(box);
    at_least = std::max(at_least, verdict.at_least);
    queue.push({verdict, box});
  };
  for (const Box& box : boxes) look_at(box);
  std::size_t looked = boxes.size();
  for (; queue.top().verdict.bound > target && !(at_least > target) && looked < budget; looked += 2) {
    const Judged worst = queue.top();
    queue.pop();
    for (const Box& half : halves(worst.box, worst.verdict.halve_alpha)) look_at(half);
  }
  return {queue.top().verdict.bound, looked};
}

AlphaTaylor alpha_variable(const Box& box) {
  return AlphaTaylor::variable(0, centre(box.alpha), half_width(box.alpha));
}
TexelTaylor texel_alpha(const Box& box) {
  return TexelTaylor::variable(0, centre(box.alpha), half_width(box.alpha));
}
TexelTaylor texel_specular(const Box& box) {
  return TexelTaylor::variable(1, centre(box.specular), half_width(box.specular));
}

// The sum over powers p of distance^p times `of` the coefficients of c_p in one cell.
template <typename OfCoefficients>
double weighed(const PiecewisePolynomial& polynomial, int cell, double distance, const OfCoefficients& of) {
  const float* first =
      polynomial.coefficients.data() + static_cast<std::size_t>(cell) * polynomial.coefficients_a_cell();
  double sum = 0.0, power = 1.0;
  for (const int degree : polynomial.degrees) {
    sum += power * of(first, degree);
    first += degree + 1;
    power *= distance;
  }
  return sum;
}

// The derivative by u or by specular. Only its sign matters, and u rises with alpha.
PiecewisePolynomial derivative(const PiecewisePolynomial& polynomial, bool by_specular) {
  PiecewisePolynomial result = polynomial;
  result.coefficients.clear();
  if (by_specular)
    result.degrees.erase(result.degrees.begin());
  else
    for (int& degree : result.degrees) degree = std::max(degree - 1, -1);
  const float* coefficient = polynomial.coefficients.data();
  for (int cell = 0; cell < polynomial.cell_count; ++cell)
    for (std::size_t power = 0; power < polynomial.degrees.size(); ++power)
      for (int i = 0; i <= polynomial.degrees[power]; ++i, ++coefficient) {
        if (by_specular && power > 0) result.coefficients.push_back(static_cast<float>(power) * *coefficient);
        if (!by_specular && i > 0) result.coefficients.push_back(static_cast<float>(i) * *coefficient);
      }
  return result;
}

// The arguments at which the polynomial is evaluated.
struct Reach {
  double u = 0.0;         // largest |u|
  double u_error = 0.0;   // of its rounding
  double distance = 0.0;  // largest |specular - middle|
};

Reach reach_of(const PiecewisePolynomial& polynomial, const ProofDomain& domain) {
  const double scale = static_cast<double>(polynomial.scale), start = static_cast<double>(polynomial.start);
  const double pole = static_cast<double>(polynomial.pole), middle = static_cast<double>(polynomial.middle);
  const auto t_of = [&](double alpha) { return pole == 0.0 ? alpha : alpha / (alpha + pole); };
  const double t = t_of(domain.alpha.max), high = t * scale - start;
  const double low = t_of(domain.alpha.min) * scale - start;
  const double farthest = std::max(std::fabs(low), std::fabs(high));
  const double t_error = pole == 0.0 ? 0.0 : 2.01 * kFloatUnit * t;
  Reach reach;
  reach.u_error = t_error * scale + kFloatUnit * (t * scale + farthest + 0.5);
  reach.u =
      polynomial.cell_count == 1 ? farthest : std::max({0.5, 0.5 - low, high - polynomial.cell_count + 0.5});
  reach.u += reach.u_error;
  reach.distance = std::max(std::fabs(domain.specular.max - middle), std::fabs(domain.specular.min - middle));
  return reach;
}

// The largest step between the polynomials of neighbouring cells at their joint.
double largest_step(const PiecewisePolynomial& polynomial, double distance) {
  const std::size_t row = polynomial.coefficients_a_cell();
  double largest = 0.0;
  for (int cell = 0; cell + 1 < polynomial.cell_count; ++cell) {
    const double step = weighed(polynomial, cell, distance, [&](const float* c, int degree) {
      double sum = 0.0;
      for (int i = degree; i >= 0; --i) {
        const double sign = i % 2 == 0 ? 1.0 : -1.0;
        sum = 0.5 * sum;  // both at |u| = 1/2; the next cell's is read at -1/2
        sum += static_cast<double>(c[i]) - sign * static_cast<double>(c[row + static_cast<std::size_t>(i)]);
      }
      return std::fabs(sum);
    });
    largest = std::max(largest, step);
  }
  return largest;
}

// A number in a float computation: the interval of its exact values, and a bound on the error of the computed
// one.
struct Uncertain {
  Uncertain() = default;
  explicit Uncertain(float number) : exact{static_cast<double>(number), static_cast<double>(number)} {}
  Uncertain(const Range& range, double off_by) : exact(range), error(off_by) {}
  Range exact;
  double error = 0.0;
  double magnitude() const { return std::max(std::fabs(exact.min), std::fabs(exact.max)); }
};

Range product(const Range& a, const Range& b) {
  const auto [low, high] = std::minmax({a.min * b.min, a.min * b.max, a.max * b.min, a.max * b.max});
  return {low, high};
}
Range sum(const Range& a, const Range& b) { return {a.min + b.min, a.max + b.max}; }

// a * x + b in floats, where the product rounds, then the sum (running error analysis: Higham 2002, section
// 5.1). A fused operation rounds only once.
Uncertain step(const Uncertain& a, const Uncertain& x, const Uncertain& b) {
  const double of_product = a.error * (x.magnitude() + x.error) + a.magnitude() * x.error;
  const double largest_product = a.magnitude() * x.magnitude() + of_product;
  const double before = of_product + kFloatUnit * largest_product + kSmallest + b.error;
  Uncertain result(sum(product(a.exact, x.exact), b.exact), 0.0);
  result.error = before + kFloatUnit * (result.magnitude() + before) + kSmallest;
  return result;
}

Uncertain square_of(const Uncertain& x) {
  const double a = std::fabs(x.exact.min), b = std::fabs(x.exact.max), largest = std::max(a, b) + x.error;
  const double smallest = x.exact.min <= 0.0 && x.exact.max >= 0.0 ? 0.0 : std::min(a, b);
  return {{smallest * smallest, x.magnitude() * x.magnitude()},
          x.error * (x.magnitude() + largest) + kFloatUnit * largest * largest + kSmallest};
}

constexpr int kSpecularPieces = 4;

// Part i of [-reach, reach].
Range part_of(double reach, int i, int pieces) {
  return {reach * (2.0 * i / pieces - 1.0), reach * (2.0 * (i + 1) / pieces - 1.0)};
}

// A bound on the error of the computed polynomial in a part of a cell, for the errors of `u` and `w`.
double rounding_in(const PiecewisePolynomial& polynomial, int cell, const Uncertain& u, const Uncertain& w) {
  const float* end =
      polynomial.coefficients.data() + static_cast<std::size_t>(cell + 1) * polynomial.coefficients_a_cell();
  Uncertain total;
  const Uncertain square = square_of(u);
  for (std::size_t power = polynomial.degrees.size(); power-- > 0;) {
    const int degree = polynomial.degrees[power];
    end -= degree + 1;
    const Uncertain factor = in_emitted_order(end, degree, u, square, step);
    total = power + 1 == polynomial.degrees.size() ? factor : step(total, w, factor);
  }
  return total.error;
}

bool proven_positive(const PiecewisePolynomial& polynomial, const ProofDomain& domain) {
  if (polynomial.coefficients.empty()) return false;
  const bool of_specular = polynomial.degrees.size() > 1;
  const auto judge = [&](const Box& box) {
    const TexelTaylor value = value_in_cell(polynomial, box.cell, texel_alpha(box), texel_specular(box));
    return verdict(value, -value.constant(), value.deviation() - value.constant(), box, of_specular);
  };
  // The coefficients of the derivative were rounded to floats again.
  const Reach reach = reach_of(polynomial, domain);
  double margin = 0.0;
  for (int cell = 0; cell < polynomial.cell_count; ++cell)
    margin = std::max(margin, weighed(polynomial, cell, reach.distance, [&](const float* c, int degree) {
                        double sum = 0.0;
                        for (int i = degree; i >= 0; --i)
                          sum = sum * reach.u + kFloatUnit * std::fabs(static_cast<double>(c[i])) + kSmallest;
                        return sum;
                      }));
  return refine(first_boxes(polynomial, domain, of_specular), -margin, kRisingBudget, judge).bound <= -margin;
}

}  // namespace

Proof proven_error(const MappedFunction& model, const PiecewisePolynomial& polynomial,
                   const ProofDomain& domain, double target, std::size_t box_budget) {
  const auto judge_alpha = [&](const Box& box) {
    const AlphaTaylor alpha = alpha_variable(box);
    const AlphaTaylor error =
        model.over_alpha(alpha) - value_in_cell(polynomial, box.cell, alpha, AlphaTaylor(1.0));
    return verdict(error, std::fabs(error.constant()), error.bound(), box, false);
  };
  const auto judge_both = [&](const Box& box) {
    const TexelTaylor alpha = texel_alpha(box), specular = texel_specular(box);
    const TexelTaylor error =
        model.over_both(alpha, specular) - value_in_cell(polynomial, box.cell, alpha, specular);
    return verdict(error, std::fabs(error.constant()), error.bound(), box, true);
  };
  const auto boxes = first_boxes(polynomial, domain, model.of_specular);
  const Proof proof = model.of_specular ? refine(boxes, target, box_budget, judge_both)
                                        : refine(boxes, target, box_budget, judge_alpha);
  return {proof.bound * (1.0 + 1e-9), proof.boxes};  // covers rounding in the additions of bounds
}

double rounding_error(const PiecewisePolynomial& polynomial, const ProofDomain& domain) {
  const Reach reach = reach_of(polynomial, domain);
  if (polynomial.cell_count > 1 && !(reach.u_error < 0.5)) return INFINITY;  // cells would be skipped
  const int pieces = std::max(4, 64 / polynomial.cell_count);
  double worst = 0.0;
  for (int cell = 0; cell < polynomial.cell_count; ++cell)
    for (int i = 0; i < pieces; ++i)
      for (int j = 0; j < kSpecularPieces; ++j) {
        const double error =
            rounding_in(polynomial, cell, Uncertain(part_of(reach.u, i, pieces), reach.u_error),
                        Uncertain(part_of(reach.distance, j, kSpecularPieces),
                                  polynomial.middle == 0.0f ? 0.0 : kFloatUnit * reach.distance));
        if (!(error <= worst)) worst = claimed(error);
      }
  // A texel that rounding moves across a joint gets the value of the neighbouring cell.
  return claimed(worst * (1.0 + 1e-9) + largest_step(polynomial, reach.distance));
}

bool proven_rising_with_alpha(const PiecewisePolynomial& polynomial, const ProofDomain& domain) {
  return proven_positive(derivative(polynomial, false), domain);
}

bool proven_rising_with_specular(const PiecewisePolynomial& polynomial, const ProofDomain& domain) {
  if (polynomial.degrees.size() < 2) return false;
  return proven_positive(derivative(polynomial, true), domain);
}

}  // namespace remap
