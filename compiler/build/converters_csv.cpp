// This file writes the table of all figures of all converters.
#include <algorithm>
#include <map>
#include <utility>

#include "build/report.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "lower/chain.hpp"

namespace remap {
namespace {

// A Row is a row of the table, keyed by column. A missing column is empty.
using Row = std::map<std::string, std::string>;

const std::vector<std::string> kColumns = {"converter",
                                           "kind",
                                           "source",
                                           "target",
                                           "warning",
                                           "image_error",
                                           "image_error_99",
                                           "ssim",
                                           "ssim_least",
                                           "ssim_least_at_alpha",
                                           "alpha_error",
                                           "specular_error",
                                           "alpha_bound",
                                           "specular_bound",
                                           "round_trip_median",
                                           "round_trip_99",
                                           "alpha_min",
                                           "alpha_max",
                                           "specular_max",
                                           "dielectric_f0",
                                           "diffuse",
                                           "formula",
                                           "template_error",
                                           "bytes",
                                           "mean_excess",
                                           "largest_excess",
                                           "excess_at_alpha",
                                           "excess_at_specular",
                                           "remarks"};

// Pairs holds measured fits by source and target.
using Pairs = std::map<std::pair<std::string, std::string>, const Fit*>;

std::string figure(double value) { return number_text(rounded(value, 3)); }

// Changes a text so that numpy's genfromtxt can read it. genfromtxt has no quotes and treats everything after
// # as a comment.
std::string cell(std::string text) {
  for (char& c : text)
    if (c == ',')
      c = ';';
    else if (c == '"')
      c = '\'';
    else if (c == '#' || c == '\n')
      c = ' ';
  return text;
}

std::string line(const Row& row) {
  std::string text;
  for (const std::string& column : kColumns) {
    const auto found = row.find(column);
    text += (column == kColumns.front() ? "" : ",") + (found == row.end() ? "" : cell(found->second));
  }
  return text + "\n";
}

void add_pictures(const Fit& fit, Row* row) {
  if (!fit.image_error) return;
  (*row)["image_error"] = figure(fit.image_error->rms);
  (*row)["image_error_99"] = figure(fit.image_error->p99);
  if (!is_measured(fit)) return;
  const auto least = std::ranges::min_element(fit.ssim, {}, &std::map<double, double>::value_type::second);
  (*row)["ssim"] = figure(*mean_ssim(fit));
  (*row)["ssim_least"] = figure(least->second);
  (*row)["ssim_least_at_alpha"] = figure(least->first);
}

// Adds how well the opposite converter restores a texel. This is the larger of the relative changes of alpha
// and specular.
void add_round_trip(const Fit& fit, const Pairs& pairs, Row* row) {
  const auto back = pairs.find({fit.target.model, fit.source.model});
  if (!is_measured(fit) || back == pairs.end()) return;
  const RoundTrip trip = round_trip(fit, *back->second);
  if (trip.share == 0.0) return;
  (*row)["round_trip_median"] = figure(std::max(trip.alpha_median, trip.specular_median));
  (*row)["round_trip_99"] = figure(std::max(trip.alpha_p99, trip.specular_p99));
}

std::string origin(const Fit& fit) {
  std::string text = joined(fit.remarks, " ");
  if (const std::string inverse = fit.table.comment("inverse_of"); !inverse.empty())
    text += "Inverse of " + inverse + ".";
  if (const auto steps = fit.method.find("against its steps one after another"); steps != fit.method.end())
    text += " Against its steps: " + steps->second + ".";
  return text;
}

Row row_of(const Fit& fit, const Pairs& pairs) {
  Row row = {{"converter", fit.id},
             {"kind", kind_name(fit.mapping)},
             {"source", fit.source.model},
             {"target", fit.target.model},
             {"warning", trust_warning(fit)},
             {"alpha_min", figure(fit.domain.alpha.min)},
             {"alpha_max", figure(fit.domain.alpha.max)},
             {"specular_max", figure(fit.domain.specular.max)},
             {"remarks", origin(fit)}};
  add_pictures(fit, &row);
  add_round_trip(fit, pairs, &row);
  if (fit.has_errors()) {
    row["alpha_error"] = figure(fit.alpha_error.rms);
    row["specular_error"] = figure(fit.specular_error.rms);
  }
  if (fit.converter) {
    row["alpha_bound"] = figure(fit.converter->alpha_bound);
    row["specular_bound"] = figure(fit.converter->specular_bound);
  }
  return row;
}

Row row_of(const WorkflowFit& fit) {
  const WorkflowConversion& conversion = fit.conversion;
  return {{"converter", fit.id},
          {"kind", material_kind(fit)},
          {"source", conversion.source_model()},
          {"target", conversion.target_model()},
          {"dielectric_f0", number_text(conversion.metallic.dielectric_f0)},
          {"diffuse", std::string(diffuse_convention_name(conversion.specular.diffuse))},
          {"formula", formula_text(conversion.formula)},
          {"remarks", joined(fit.remarks, " ")}};
}

Row row_of(const WarpMapFit& fit) {
  Row row = {{"converter", fit.id},
             {"kind", "warp"},
             {"source", fit.source_model},
             {"target", fit.template_model},
             {"bytes", std::to_string(byte_count(fit.warp))}};
  if (fit.copy_rms_error >= 0.0) row["template_error"] = figure(fit.copy_rms_error);
  return row;
}

}  // namespace

std::string converters_csv(const FitFolder& folder) {
  Row head;
  for (const std::string& column : kColumns) head[column] = column;
  Pairs pairs;
  for (const Fit& fit : folder.fits)
    if (is_measured(fit)) pairs[{fit.source.model, fit.target.model}] = &fit;
  std::string text = line(head);
  for (const Fit* fit : by_trust(folder.fits)) {
    Row row = row_of(*fit, pairs);
    if (const auto reach = folder.reach.find(fit->id); reach != folder.reach.end()) {
      row["mean_excess"] = figure(reach->second.mean_excess);
      row["largest_excess"] = figure(reach->second.largest_excess);
      row["excess_at_alpha"] = figure(reach->second.alpha);
      row["excess_at_specular"] = figure(reach->second.specular);
    }
    text += line(row);
  }
  for (const WorkflowFit& fit : folder.workflows) text += line(row_of(fit));
  for (const WarpMapFit& fit : folder.warps) text += line(row_of(fit));
  return text;
}

}  // namespace remap
