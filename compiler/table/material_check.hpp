// Checks a table of named parameters before it is fitted.
#pragma once

#include <vector>

#include "table/check.hpp"
#include "table/material_table.hpp"

namespace remapc {

// Returns findings like check_table: values that are not finite, too few usable rows for the number of
// columns, source columns with a single value, repeated samples, and many rows with the same target value.
std::vector<Finding> check_material_table(const MaterialTable& table);

}  // namespace remapc
