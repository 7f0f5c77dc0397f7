// Texels of the specular workflow as rows: diffuse, specular, alpha.
#pragma once

#include <array>
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

// A few values are beyond 0 to 1.
inline WarpRows random_rows(std::size_t count) {
  WarpRows rows(count);
  std::mt19937 engine(3);
  for (auto& row : rows.row)
    for (float& value : row) value = static_cast<float>(engine() >> 8) * 0x1.1p-24f - 0.02f;
  return rows;
}

}  // namespace remap
