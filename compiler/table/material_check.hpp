// Checks a table of many named parameters before it is fitted.
#pragma once

#include <vector>

#include "table/check.hpp"
#include "table/material_table.hpp"

namespace remapc {

// What is wrong with a table before it is fitted, as check_table: values that are not finite, too few usable
// rows for its columns, source columns that never change, samples that stand twice, many rows of one target
// value.
std::vector<Finding> check_material_table(const MaterialTable& table);

}  // namespace remapc
