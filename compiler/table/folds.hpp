// This file draws rows of a table.
#pragma once

#include <cstdint>
#include <vector>

#include "table/table.hpp"

namespace remap {

// Draws `count` of `rows` (all if there are fewer) by `seed` and keeps their order.
std::vector<TableRow> draw_rows(const std::vector<TableRow>& rows, std::size_t count, std::uint64_t seed);

}  // namespace remap
