// The file format of lookup tables.
#include "emit/convention_text.hpp"
#include "emit/lookup_table.hpp"
#include "emit/text_template.hpp"
#include "fit/rows/split.hpp"
#include "remap/convention.hpp"
#include "remap/version.hpp"
#include "text/number_text.hpp"
#include "text/report_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

constexpr int kFormatVersion = 1;

// Keys and values.
using Head = std::vector<std::pair<std::string, std::string>>;

void add_side(Head& head, const std::string& role, const remap::ModelSide& side) {
  head.emplace_back(role, side.model);
  head.emplace_back(role + "_roughness", convention_name(side.roughness));
  head.emplace_back(role + "_specular", side.specular);
}

// What the widths of a table in alpha mean, where that is not the model's own parameter.
void add_convention(Head& head, const std::string& column, remap::RoughnessConvention own) {
  if (own != remap::RoughnessConvention::kAlpha) head.emplace_back(column, convention_text(own).formula);
}

void add_reading(Head& head, const remap::Fit& fit, const LookupTable& table) {
  const bool two_axes = table.axes.size() == 2;
  const std::string specular = "target_" + fit.target.specular;
  head.emplace_back("interpolation", two_axes ? "bilinear" : "linear");
  if (two_axes) head.emplace_back("order", "the last axis varies fastest");
  if (table.columns.back().name == specular + "_factor")
    head.emplace_back("factor", fit.target.specular + " of the target = factor * " + fit.source.specular +
                                    " of the source, for each channel");
  std::string outside = "hold " + table.axes[0].name + " at the end of its axis";
  if (two_axes)
    outside += "; where a channel is beyond the last " + table.axes[1].name +
               ", divide all channels by what brings the largest there, look up, multiply by it";
  head.emplace_back("outside", outside);
  if (table.axes[0].name == "source_alpha") add_convention(head, "source_alpha", fit.source.roughness);
  if (table.columns[0].name == "target_alpha") add_convention(head, "target_alpha", fit.target.roughness);
}

}  // namespace

std::string lookup_text(const remap::Fit& fit, const LookupTable& table) {
  const auto name = [](const auto& part) { return part.name; };
  Head head = {{"format", "remap-lookup"},
               {"format_version", std::to_string(kFormatVersion)},
               {"tool", std::string("remapc ") + remap::kVersion},
               {"id", fit.id},
               {"kind", kind_name(fit.mapping)}};
  add_side(head, "source", fit.source);
  add_side(head, "target", fit.target);
  if (!fit.table.sha256.empty()) head.emplace_back("fitted_table_sha256", fit.table.sha256);
  head.emplace_back("axes", joined(table.axes, ",", name));
  head.emplace_back("size", joined(table.axes, ",",
                                   [](const LookupAxis& a) { return std::to_string(a.positions.size()); }));
  head.emplace_back("domain_min",
                    joined(table.axes, ",", [](const auto& a) { return number_text(a.positions.front()); }));
  head.emplace_back("domain_max",
                    joined(table.axes, ",", [](const auto& a) { return number_text(a.positions.back()); }));
  head.emplace_back("columns", joined(table.columns, ",", name));
  add_reading(head, fit, table);
  head.emplace_back("lookup_error_max",
                    joined(table.columns, ",", [](const auto& c) { return error_text(c.max_error); }));
  head.emplace_back("lookup_error_rms",
                    joined(table.columns, ",", [](const auto& c) { return error_text(c.rms_error); }));
  head.emplace_back("lookup_error_samples", std::to_string(table.judged_count));

  std::string text =
      comment_lines(head) + joined(table.axes, ",", name) + "," + joined(table.columns, ",", name) + "\n";
  const std::size_t speculars = table.axes.size() == 2 ? table.axes[1].positions.size() : 1;
  for (std::size_t row = 0; row < table.columns[0].values.size(); ++row) {
    text += number_text(table.axes[0].positions[row / speculars]);
    if (table.axes.size() == 2) text += "," + number_text(table.axes[1].positions[row % speculars]);
    for (const LookupColumn& column : table.columns) text += "," + number_text(column.values[row]);
    text += "\n";
  }
  return text;
}

}  // namespace remapc
