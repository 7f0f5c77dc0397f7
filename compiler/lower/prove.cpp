#include "lower/prove.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>

#include "lower/taylor.hpp"

namespace remap {
namespace {

constexpr double kFloatUnit = 1.0 / 16777216.0;  // unit roundoff of a float, 2^-24
// Returns how much the domain is widened. Converters read the model's own parameter as a float. So the ends
// of the domain move by a few units in the last place of alpha, or for glossiness of 1 - sqrt(alpha).
double room(double alpha) { return 2e-6 * alpha + 1.5e-7 * std::sqrt(alpha); }

using TexelTaylor = Taylor<2, 7>;  // variable 0 is alpha, variable 1 specular
using TexelFunction = std::function<TexelTaylor(const TexelTaylor& alpha, const TexelTaylor& specular)>;

// A Box is a part of the domain, with the result of an enclosure over it.
struct Box {
  Range alpha, specular;
  int alpha_halvings = 0, specular_halvings = 0;
  double bound = INFINITY;      // infinite also if the enclosure failed
  double at_least = -INFINITY;  // no bound can be lower
  bool halve_alpha = true;      // the direction in which to halve the box
  bool operator<(const Box& other) const { return bound < other.bound; }
};

double centre(const Range& range) { return 0.5 * (range.min + range.max); }
double half_width(const Range& range) { return 0.5 * (range.max - range.min); }

// Replaces NaN by infinity, because comparisons would lose NaN.
double claimed(double bound) { return std::isnan(bound) ? INFINITY : bound; }

void judge(Box& box, const TexelTaylor& error) {
  box.bound = claimed(error.bound());
  box.at_least = std::fabs(error.constant()) - error.rest();
  // If the remainder is larger than the polynomial, its extents mean nothing. The box is then halved along
  // alpha and specular in turn.
  const double alpha = error.extent(0), specular = error.extent(1);
  const bool tells = std::isfinite(box.bound) && std::max(alpha, specular) > 0.01 * error.rest();
  box.halve_alpha = tells ? alpha >= specular : box.alpha_halvings <= box.specular_halvings;
}

// Returns the initial boxes.
std::vector<Box> first_boxes(const Domain& domain) {
  constexpr int kAlphaBoxes = 16, kSpecularBoxes = 4;
  const Range alpha{domain.alpha.min - room(domain.alpha.min), domain.alpha.max + room(domain.alpha.max)};
  const Range specular{domain.specular.min * (1.0 - 2e-6), domain.specular.max * (1.0 + 2e-6)};
  // The spacing is quadratic, because curves bend most close to 0.
  const auto part = [](const Range& range, int k, int count) {
    return k == count ? range.max : range.min + (range.max - range.min) * k * k / (count * count);
  };
  std::vector<Box> boxes;
  for (int i = 0; i < kAlphaBoxes; ++i)
    for (int j = 0; j < kSpecularBoxes; ++j)
      boxes.push_back({{part(alpha, i, kAlphaBoxes), part(alpha, i + 1, kAlphaBoxes)},
                       {part(specular, j, kSpecularBoxes), part(specular, j + 1, kSpecularBoxes)}});
  return boxes;
}

std::array<Box, 2> halves(const Box& box) {
  Box low = box, high = box;
  if (box.halve_alpha) {
    low.alpha.max = high.alpha.min = centre(box.alpha);
    low.alpha_halvings = ++high.alpha_halvings;
  } else {
    low.specular.max = high.specular.min = centre(box.specular);
    low.specular_halvings = ++high.specular_halvings;
  }
  return {low, high};
}

// Halves the worst box again and again. Ends when the worst bound is at most `target`, when the budget is
// spent, or when `target` clearly cannot be reached.
double proven_bound(const TexelFunction& error, const Domain& domain, double target, std::size_t budget) {
  std::priority_queue<Box> queue;
  double at_least = -INFINITY;
  const auto look_at = [&](Box box) {
    const TexelTaylor alpha = TexelTaylor::variable(0, centre(box.alpha), half_width(box.alpha));
    const TexelTaylor specular = TexelTaylor::variable(1, centre(box.specular), half_width(box.specular));
    judge(box, error(alpha, specular));
    at_least = std::max(at_least, box.at_least);
    queue.push(box);
  };
  const std::vector<Box> boxes = first_boxes(domain);
  for (const Box& box : boxes) look_at(box);
  for (std::size_t looked = boxes.size();
       queue.top().bound > target && !(at_least > target) && looked < budget; looked += 2) {
    const std::array<Box, 2> parts = halves(queue.top());
    queue.pop();
    for (const Box& part : parts) look_at(part);
  }
  return queue.top().bound * (1.0 + 1e-9);  // covers rounding in the additions of bounds
}

// Returns the sum of the magnitudes of a factor's terms.
double magnitude(const FactorTerms& factor, double alpha, double t) {
  FactorTerms magnitudes = factor;
  for (std::vector<float>& row : magnitudes)
    for (float& term : row) term = std::fabs(term);
  return factor_value(magnitudes, alpha, t);
}

// Returns the number of operations that compute a factor.
std::size_t operations(const FactorTerms& factor) {
  std::size_t longest = 0;
  for (const std::vector<float>& row : factor) longest = std::max(longest, row.size());
  return 2 * (factor.size() + longest);
}

}  // namespace

MappedTexel proven_distance(const MappingKind& mapping, const CompactForm& form, const Domain& domain,
                            const MappedTexel& target, std::size_t box_budget) {
  return std::visit(
      [&](const auto& kind) {
        const auto alpha = [&](const TexelTaylor& a, const TexelTaylor& s) {
          return target_alpha(kind, a, s) - target_alpha(form, a, s);
        };
        const auto specular = [&](const TexelTaylor& a, const TexelTaylor& s) {
          return target_specular(kind, a, s) - target_specular(form, a, s);
        };
        return MappedTexel{proven_bound(alpha, domain, target.alpha, box_budget),
                           proven_bound(specular, domain, target.specular, box_budget)};
      },
      mapping);
}

MappedTexel rounding_of(const CompactForm& form, const Domain& domain) {
  const double alpha = domain.alpha.max, specular = domain.specular.max;
  const double t = specular / (specular + static_cast<double>(form.pole));
  // The error is relative to the sum of the magnitudes. It covers the sum, the quotient, and then either
  // width and product or the hinge.
  const auto relative = [](std::size_t operations) {
    const double n = static_cast<double>(operations) * 2.0 * kFloatUnit;
    return n / (1.0 - n);
  };
  constexpr std::size_t kOthers = 6, kHinge = 9;
  const double of_alpha = relative(operations(form.alpha) + kOthers),
               of_specular = relative(operations(form.specular) + kOthers), of_hinge = relative(kHinge);
  const double width = alpha * magnitude(form.alpha, alpha, t),
               light = specular * magnitude(form.specular, alpha, t);
  MappedTexel distance{of_alpha * width, of_specular * light};
  const auto size = [](float number) { return std::fabs(static_cast<double>(number)); };
  if (form.specular_limit) {
    // x / (1 + bend x) changes by no more than x does, and is at most 1 / bend.
    const double cut = light / size(*form.specular_limit),
                 most = std::min(cut, 1.0 / std::max(size(form.hinge.bend), 1e-9));
    distance.alpha += alpha * (size(form.hinge.turn) + size(form.hinge.turn_by_alpha) * alpha) *
                      (of_specular * cut + of_hinge * (most + 1.0));
  }
  if (form.alpha_limit) {
    const double wide = width / size(*form.alpha_limit);
    distance.specular += light * size(form.hinge.spread) * (of_alpha * wide + of_hinge * (wide + 1.0));
  }
  return {distance.alpha + 1e-37, distance.specular + 1e-37};
}

}  // namespace remap
