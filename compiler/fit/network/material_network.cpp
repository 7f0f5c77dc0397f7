#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "fit/network/fit_network.hpp"
#include "remap/version.hpp"
#include "table/regression.hpp"
#include "table/table.hpp"

namespace remap {
namespace {

constexpr double kLargestDeviation = 1e-3;

// A MaterialRow holds the inputs and outputs of the network for one row.
struct MaterialRow {
  std::array<double, 6> specular{};  // diffuse, F0
  std::array<double, 4> metallic{};  // base color, metallic
};

std::size_t place_of(const MaterialTable& table, const std::vector<std::string>& columns,
                     const std::string& name) {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end())
    throw input_error(table.name + ": missing column " + name +
                      " (use a table of remapc sample from a metallic to a specular model)");
  return static_cast<std::size_t>(found - columns.begin());
}

std::vector<MaterialRow> material_rows(const MaterialTable& table) {
  std::array<std::size_t, 6> specular{};
  std::array<std::size_t, 4> metallic{};
  const std::array<std::string, 3> channels = {"_r", "_g", "_b"};
  for (std::size_t c = 0; c < 3; ++c) {
    specular[c] = place_of(table, table.target_columns, "diffuse" + channels[c] + "2");
    specular[3 + c] = place_of(table, table.target_columns, "f0" + channels[c] + "2");
    metallic[c] = place_of(table, table.source_columns, "base_color" + channels[c] + "1");
  }
  metallic[3] = place_of(table, table.source_columns, "metallic1");
  std::vector<MaterialRow> rows;
  for (const NamedRow& row : table.rows) {
    if (row.status != RowStatus::kOk) continue;
    MaterialRow material;
    for (std::size_t i = 0; i < specular.size(); ++i) material.specular[i] = row.target[specular[i]];
    for (std::size_t i = 0; i < metallic.size(); ++i) material.metallic[i] = row.source[metallic[i]];
    rows.push_back(material);
  }
  if (rows.empty())
    throw input_error(table.name + ": no row has status ok (a network needs thousands of rows)");
  return rows;
}

// Returns the F0 of dielectrics that fits equation (2) to the rows best, to six digits.
double dielectric_f0_of(const std::vector<MaterialRow>& rows) {
  double products = 0.0, squares = 0.0;
  for (const MaterialRow& row : rows)
    for (std::size_t c = 0; c < 3; ++c) {
      const double metal = row.metallic[3];
      products += (1.0 - metal) * (row.specular[3 + c] - row.metallic[c] * metal);
      squares += (1.0 - metal) * (1.0 - metal);
    }
  return squares > 0.0 ? rounded(products / squares, 6) : 0.0;
}

// Returns the RMS deviation of a quantity from equation (2). Its channels begin at `first` of
// MaterialRow::specular, and `expected` returns its value for a base color and metallic.
double deviation_of(const std::vector<MaterialRow>& rows, std::size_t first, const auto& expected) {
  double square = 0.0;
  for (const MaterialRow& row : rows)
    for (std::size_t c = 0; c < 3; ++c)
      square += std::pow(row.specular[first + c] - expected(row.metallic[c], row.metallic[3]), 2);
  return std::sqrt(square / (3.0 * static_cast<double>(rows.size())));
}

std::string comment_of(const MaterialTable& table, const std::string& key) {
  for (const auto& [name, value] : table.comments)
    if (name == key) return value;
  throw input_error(table.name + ": missing comment " + key + " (remapc sample writes it)");
}

RoughnessEncoding width_of(const MaterialTable& table, const std::string& key) {
  const std::string name = comment_of(table, key);
  const auto convention = encoding_from_name(name);
  if (!convention)
    throw input_error(table.name + ": unknown convention '" + name + "' in the comment " + key);
  return *convention;
}

WorkflowConversion conversion_of(const MaterialTable& table, double dielectric_f0) {
  WorkflowConversion conversion;
  conversion.specular.model = comment_of(table, "target");
  conversion.specular.width = width_of(table, "target_roughness");
  conversion.metallic.model = comment_of(table, "source");
  conversion.metallic.width = width_of(table, "source_roughness");
  conversion.metallic.dielectric_f0 = dielectric_f0;
  return conversion;
}

Split split_of(const MaterialTable& table, std::size_t rows, const MaterialNetworkOptions& options) {
  Split split = split_record(options.seed, options.held_out_fraction, rows);
  for (const NamedRow& row : table.rows)
    if (row.status != RowStatus::kOk) ++split.left_out[std::string(status_name(row.status))];
  return split;
}

std::vector<MaterialRow> in_seeded_order(const std::vector<MaterialRow>& rows, std::uint64_t seed) {
  std::vector<MaterialRow> result;
  for (const std::size_t row : seeded_order(rows.size(), seed)) result.push_back(rows[row]);
  return result;
}

Samples samples_of(std::span<const MaterialRow> rows) {
  Samples samples{6, 4, {}, {}};
  for (const MaterialRow& row : rows) {
    samples.inputs.insert(samples.inputs.end(), row.specular.begin(), row.specular.end());
    samples.outputs.insert(samples.outputs.end(), row.metallic.begin(), row.metallic.end());
  }
  return samples;
}

// Computes the errors of the converter. Its outputs are clamped to the range from 0 to 1.
void judge(const Network& network, std::span<const MaterialRow> rows, NetworkTraining* training) {
  std::vector<double> colors, metals;
  for (const MaterialRow& row : rows) {
    const std::vector<double> outputs =
        network_outputs(network, std::vector<double>(row.specular.begin(), row.specular.end()));
    for (std::size_t i = 0; i < 4; ++i)
      (i < 3 ? colors : metals).push_back(std::clamp(outputs[i], 0.0, 1.0) - row.metallic[i]);
  }
  training->base_color = error_figures(std::move(colors));
  training->metallic = error_figures(std::move(metals));
}

}  // namespace

WorkflowFit fit_material_network(const MaterialTable& table, std::string_view bytes,
                                 const MaterialNetworkOptions& options, const FitProgress& progress) {
  const std::vector<MaterialRow> rows = material_rows(table);
  const double dielectric_f0 = dielectric_f0_of(rows);
  const double diffuse_deviation =
      deviation_of(rows, 0, [](double base, double metal) { return base * (1.0 - metal); });
  const double f0_deviation = deviation_of(
      rows, 3, [&](double base, double metal) { return dielectric_f0 * (1.0 - metal) + base * metal; });
  if (f0_deviation > kLargestDeviation || diffuse_deviation > kLargestDeviation)
    throw input_error(table.name + ": rows differ from equation (2) by " +
                      number_text(std::max(f0_deviation, diffuse_deviation)) + " (rms), more than " +
                      number_text(kLargestDeviation) +
                      " (both models must have the same BRDF and plain diffuse)");
  WorkflowFit fit;
  fit.conversion = conversion_of(table, dielectric_f0);
  fit.id = fit_id(options.id, fit.conversion.specular.model, fit.conversion.metallic.model);
  const Split split = split_of(table, rows.size(), options);
  const std::vector<MaterialRow> drawn = in_seeded_order(rows, options.seed);
  const auto held_out = std::span(drawn).first(static_cast<std::size_t>(split.held_out_rows));
  const auto training = std::span(drawn).subspan(held_out.size());
  const TrainedNetwork trained = train_network(samples_of(training), options, progress);
  fit.conversion.formula = trained.network;
  fit.training.emplace();
  fit.training->method["network"] = trained.method;
  fit.training->method["table_against_equation_2"] =
      "rms of f0 " + error_text(f0_deviation) + ", of diffuse " + error_text(diffuse_deviation);
  judge(trained.network, held_out, &*fit.training);
  fit.training->split = split;
  fit.training->table = table_record(table.name, bytes, table.comments);
  fit.tool_version = kVersion;
  require_valid(fit.conversion, fit.id);
  return fit;
}

}  // namespace remap
