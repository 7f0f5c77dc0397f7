// Parts of fit files that several kinds of fits hold: numbers, scalings, networks, and what a fit was learned
// from.
#pragma once

#include <cstddef>
#include <vector>

#include "remap/fit.hpp"
#include "text/json_field.hpp"

namespace remap {

// The number itself. Throws kNumeric where it is not finite.
double finite(double value);
nlohmann::ordered_json numbers_json(const std::vector<double>& numbers);

nlohmann::ordered_json scalings_json(const std::vector<Scaling>& scalings);
Scaling read_scaling(const Field& field);
Scaling read_output_scaling(const Field& field);

nlohmann::ordered_json network_json(const Network& network);
// Throws kInput for another number of outputs and for layers that do not fit each other.
Network read_network(const Field& field, std::size_t output_count);

nlohmann::ordered_json figures_json(const ErrorFigures& figures);
ErrorFigures read_figures(const Field& field);

nlohmann::ordered_json split_json(const Split& split);
Split read_split(const Field& field);

nlohmann::ordered_json table_record_json(const TableRecord& table);
TableRecord read_table_record(const Field& field);

}  // namespace remap
