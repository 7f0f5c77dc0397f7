// This file reads and writes the JSON parts that manifests and several kinds of fits have in common. Writers
// throw kNumeric if a number is not finite. Readers throw kInput if a field is wrong.
#pragma once

#include <cstddef>
#include <vector>

#include "converter/converter_data.hpp"
#include "core/json_field.hpp"
#include "lower/fit.hpp"
#include "lower/fit_file.hpp"

namespace remap {

Json numbers_json(const std::vector<double>& numbers);

Json scaling_json(const Scaling& scaling);
Json scalings_json(const std::vector<Scaling>& scalings);
Scaling read_scaling(const Field& field);
Scaling read_output_scaling(const Field& field);

Json network_json(const Network& network);
// Reads a network. Refuses it if the number of outputs differs or if layers do not fit each other.
Network read_network(const Field& field, std::size_t output_count);

Json figures_json(const ErrorFigures& figures);
ErrorFigures read_figures(const Field& field);

Json split_json(const Split& split);
Split read_split(const Field& field);

Json table_record_json(const TableRecord& table);
TableRecord read_table_record(const Field& field);

// Reads one end of a fit between workflows.
SpecularWorkflow read_specular_workflow(const Field& side);
MetallicWorkflow read_metallic_workflow(const Field& side);

// Reads the fields `source`, `target` and `mapping` of a fit between workflows. Refuses conversions that
// require_valid() refuses.
WorkflowConversion read_conversion(const Field& fit);

// These functions read the fit of each kind whose file has this root.
Fit read_fit(const Field& root);
WorkflowFit read_workflow_fit(const Field& root);

}  // namespace remap
