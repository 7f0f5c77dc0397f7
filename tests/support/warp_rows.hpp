// This file holds texels of the specular workflow as rows: diffuse, specular, alpha.
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "remap/warp.hpp"

namespace remap {

struct WarpRows {
  explicit WarpRows(std::size_t count) { row.fill(std::vector<float>(count)); }
  std::array<std::vector<float>, kWarpParameters> row;

  std::array<const float*, kWarpParameters> sources() const {
    std::array<const float*, kWarpParameters> all{};
    for (std::size_t r = 0; r < all.size(); ++r) all[r] = row[r].data();
    return all;
  }
  std::array<float*, kWarpParameters> targets() {
    std::array<float*, kWarpParameters> all{};
    for (std::size_t r = 0; r < all.size(); ++r) all[r] = row[r].data();
    return all;
  }
  WarpTexel texel(std::size_t i) const {
    WarpTexel values{};
    for (std::size_t r = 0; r < values.size(); ++r) values[r] = row[r][i];
    return values;
  }
};

// Returns random rows. A few values are beyond 0 to 1.
inline WarpRows random_rows(std::size_t count) {
  WarpRows rows(count);
  std::mt19937 engine(3);
  for (auto& row : rows.row)
    for (float& value : row) value = static_cast<float>(engine() >> 8) * 0x1.1p-24f - 0.02f;
  return rows;
}

// Returns random rows. In some texels, channels are NaN, infinite, negative or the least numbers. In some of
// these texels, all channels are.
inline WarpRows odd_rows(std::size_t count) {
  WarpRows rows = random_rows(count);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const float odd[] = {nan,    -nan,   infinity, -infinity, -1e30f, 0.0f,  -0.0f,
                       1e-45f, 1e-40f, 1.2e-38f, 1e-30f,    1e-12f, 1e-6f, 1e-3f};
  for (std::size_t k = 0; k < std::size(odd); ++k)
    for (std::size_t r = 0; r < kWarpParameters; ++r) {
      rows.row[r][50 * r + k] = odd[k];
      rows.row[r][50 * kWarpParameters + k] = odd[k];
    }
  return rows;
}

// Returns true for the same bits, or NaN in both.
inline bool same_rows(const WarpRows& a, const WarpRows& b) {
  for (std::size_t r = 0; r < kWarpParameters; ++r)
    for (std::size_t i = 0; i < a.row[r].size(); ++i)
      if (std::memcmp(&a.row[r][i], &b.row[r][i], sizeof(float)) != 0 &&
          !(std::isnan(a.row[r][i]) && std::isnan(b.row[r][i])))
        return false;
  return true;
}

// Returns how many texels differ from the warp in double precision. It tolerates the few copied nodes that
// floats and doubles round to different sides.
inline std::size_t wrong_texels(const CompiledWarp& warp, const WarpRows& in, const WarpRows& out) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < in.row[0].size(); ++i) {
    const WarpTexel expected = evaluate_warp(warp, in.texel(i)), found = out.texel(i);
    bool close = true;
    for (std::size_t p = 0; p < kWarpParameters; ++p)
      close = close &&
              (std::isnan(expected[p]) ? std::isnan(found[p]) : std::fabs(found[p] - expected[p]) < 1e-4f);
    wrong += close ? 0 : 1;
  }
  const std::size_t rounded = std::holds_alternative<CopiedNodes>(warp.table.entries) ? 4 : 0;
  return wrong > rounded ? wrong - rounded : 0;
}

}  // namespace remap
