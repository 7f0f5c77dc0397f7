// Which box of source parameters a table covers: the domain of the fits to it.
#pragma once

#include "table/table.hpp"

namespace remapc {

// The box with alpha1 in a range and specular1 from 0 to a bound, in which every width has usable rows up to
// the bound and no row is clamped (covered_box.hpp chooses among those that there are). Rows of other
// statuses are gaps and bound nothing. Throws kInput for a table without such a box.
remap::Domain table_domain(const Table& table);

// `0.01 to 1`.
std::string range_text(const remap::Range& range);

// The table with the roles of source and target reversed: its usable rows with parameters exchanged
// (Sztrajman et al. 2019, section 5). Comments stay as they are, since they say how the table was made, with
// `roles: swapped` after them and without the spheres, whose widths are those of the other side.
Table swapped(const Table& table);

}  // namespace remapc
