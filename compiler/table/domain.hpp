// This file finds the box of source parameters that a table covers: the domain of its fits.
#pragma once

#include "table/table.hpp"

namespace remap {

// Returns the box with alpha1 in a range and specular1 from 0 to a bound. In this box, every width has usable
// rows up to the bound, and no other row is clamped. covered_box() chooses among such boxes. Rows of other
// statuses are gaps, which do not limit the box. Throws kInput if there is no such box.
Domain table_domain(const Table& table);

// Formats a range as `0.01 to 1`.
std::string range_text(const Range& range);

// Exchanges source and target of the table's usable rows (Sztrajman et al. 2019, section 5). Comments are
// kept, because they record how the table was made, and `roles: swapped` is added. Comments about one role
// are removed: the comparison of spheres, which lists widths of the source, and the target's limits. Widths
// of the target that differ only by the rounding of the measurement (1e-9 of the width) become one.
Table swapped(const Table& table);

}  // namespace remap
