// The order of operations of generated code, over any number type.
#pragma once

namespace remap {

// From this degree on, even and odd powers are summed separately, because a processor can overlap both sums.
inline constexpr int kShortestSplit = 4;

// c[0] + c[1] u + ... + c[degree] u^degree in the order of operations of generated code. `square`: u * u.
// `times_plus(a, x, b)`: a * x + b.
template <typename Number, typename TimesPlus>
Number in_emitted_order(const float* c, int degree, const Number& u, const Number& square,
                        const TimesPlus& times_plus) {
  if (degree < 0) return Number{};
  Number sum{c[degree]};
  if (degree < kShortestSplit) {
    for (int i = degree - 1; i >= 0; --i) sum = times_plus(sum, u, Number{c[i]});
    return sum;
  }
  Number next{c[degree - 1]};
  for (int i = degree - 2; i >= 0; --i) {
    Number& same = (degree - i) % 2 == 0 ? sum : next;
    same = times_plus(same, square, Number{c[i]});
  }
  return degree % 2 == 0 ? times_plus(next, u, sum) : times_plus(sum, u, next);
}

}  // namespace remap
