// This file makes rows of texels for tests of converters: random texels, edges, and invalid values.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

struct TestTexels {
  std::vector<float> roughness;
  std::array<std::vector<float>, 3> specular;
};

// Returns every pair of special values in roughness and channel, then random texels inside and outside the
// domain.
inline TestTexels odd_and_random_texels(const ConverterInfo& info, std::size_t random_count) {
  const auto odd_values = [](const Range& range) {
    const float low = static_cast<float>(range.min), high = static_cast<float>(range.max);
    const float below = std::nextafter(low, -1.0f), above = std::nextafter(high, 2.0f * high + 1.0f),
                middle = 0.5f * (low + high), far = 10.0f * high, inf = INFINITY, nan = NAN;
    return std::vector<float>{low, high,  below, above,  middle, 0.0f, -0.0f, -1.0f, 1e-40f,
                              far, 1e20f, 3e38f, -3e38f, inf,    -inf, nan,   -nan};
  };
  TestTexels rows;
  const auto add = [&rows](float roughness, float red, float green, float blue) {
    rows.roughness.push_back(roughness);
    rows.specular[0].push_back(red);
    rows.specular[1].push_back(green);
    rows.specular[2].push_back(blue);
  };
  const float middle = static_cast<float>(0.5 * info.specular.max);
  for (const float roughness : odd_values(info.roughness))
    for (const float specular : odd_values(info.specular)) add(roughness, middle, specular, 0.1f * middle);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(-0.1f, 1.2f);
  for (std::size_t i = 0; i < random_count; ++i) {
    const auto channel = [&] { return share(random) * static_cast<float>(info.specular.max); };
    const float roughness = static_cast<float>(info.roughness.min) +
                            share(random) * static_cast<float>(info.roughness.max - info.roughness.min);
    const float red = channel(), green = channel(), blue = channel();
    add(roughness, red, green, blue);
  }
  return rows;
}

// A Converted is the result for `count` texels, beginning with the texel `first`, and for the first
// `channels` channels. The texels were converted in place in a copy, or into other rows.
struct Converted {
  TestTexels rows;
  std::size_t out_of_domain = 0;
};
// `converter` is a Converter, or has the same convert() for width and specular.
template <class Convert>
Converted converted(const Convert& converter, const TestTexels& given, std::size_t first, std::size_t count,
                    std::size_t channels, bool in_place) {
  const auto cut = [&](const std::vector<float>& row) {
    const auto begin = row.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<float>(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  Converted result{{cut(given.roughness), {}}, 0};
  std::array<const float*, 3> in{};
  std::array<float*, 3> out{};
  for (std::size_t c = 0; c < channels; ++c) {
    result.rows.specular[c] = cut(given.specular[c]);
    out[c] = result.rows.specular[c].data();
    in[c] = in_place ? out[c] : given.specular[c].data() + first;
  }
  float* roughness = result.rows.roughness.data();
  result.out_of_domain = converter.convert(count, in_place ? roughness : given.roughness.data() + first,
                                           {in.data(), channels}, roughness, {out.data(), channels});
  return result;
}

// Returns true if all bits are equal, or both values are NaN.
inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::memcmp(&a[i], &b[i], sizeof(float)) != 0 && !(std::isnan(a[i]) && std::isnan(b[i])))
      return false;
  return true;
}

// Returns true if `converter` gives the bits of `expected` for all `texels`: for rows of many lengths, one
// and three channels, in place and not.
template <class Expected>
bool same_bits(const Converter& converter, const Expected& expected, const TestTexels& texels) {
  const std::size_t all = texels.roughness.size();
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{15}, std::size_t{127}, std::size_t{128},
        std::size_t{129}, std::size_t{301}, all})
    for (const std::size_t channels : {std::size_t{1}, std::size_t{3}})
      for (const bool in_place : {false, true}) {
        const std::size_t first = all - count;
        const Converted a = converted(converter, texels, first, count, channels, in_place);
        const Converted b = converted(expected, texels, first, count, channels, false);
        if (a.out_of_domain != b.out_of_domain || !same_bits(a.rows.roughness, b.rows.roughness))
          return false;
        for (std::size_t c = 0; c < channels; ++c)
          if (!same_bits(a.rows.specular[c], b.rows.specular[c])) return false;
      }
  return true;
}

}  // namespace remap
