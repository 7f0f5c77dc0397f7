// The file format of lookup tables.
#include "emit/convention_text.hpp"
#include "emit/lookup_table.hpp"
#include "emit/text_template.hpp"
#include "fit/rows/split.hpp"
#include "model/convention.hpp"
#include "remap/version.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

constexpr int kFormatVersion = 1;

class Head {
 public:
  void add(const std::string& key, const std::string& value) { text_ += "# " + key + ": " + value + "\n"; }
  void add(const std::string& role, const remap::ModelSide& side) {
    add(role, side.model);
    add(role + "_roughness", std::string(convention_name(side.roughness)));
    add(role + "_specular", side.specular);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// What the widths of a table in alpha mean, where that is not the model's own parameter.
void add_convention(Head& head, const std::string& column, remap::RoughnessConvention own) {
  if (own != remap::RoughnessConvention::kAlpha) head.add(column, convention_text(own).formula);
}

std::string name_of(const LookupAxis& axis) { return axis.name; }
std::string name_of(const LookupColumn& column) { return column.name; }

bool has(const LookupTable& table, const std::string& name) {
  for (const LookupAxis& axis : table.axes)
    if (axis.name == name) return true;
  for (const LookupColumn& column : table.columns)
    if (column.name == name) return true;
  return false;
}

void add_reading(Head& head, const remap::Fit& fit, const LookupTable& table) {
  const bool two_axes = table.axes.size() == 2;
  const std::string specular = "target_" + fit.target.specular;
  head.add("interpolation", two_axes ? "bilinear" : "linear");
  if (two_axes) head.add("order", "the last axis varies fastest");
  if (has(table, specular + "_factor"))
    head.add("factor", fit.target.specular + " of the target = factor * " + fit.source.specular +
                           " of the source, for each channel");
  std::string outside = "hold " + table.axes[0].name + " at the end of its axis";
  if (two_axes)
    outside += "; where a channel is beyond the last " + table.axes[1].name +
               ", divide all channels by what brings the largest there, look up, multiply by it";
  head.add("outside", outside);
  if (has(table, "source_alpha")) add_convention(head, "source_alpha", fit.source.roughness);
  if (has(table, "target_alpha")) add_convention(head, "target_alpha", fit.target.roughness);
}

}  // namespace

std::string lookup_text(const remap::Fit& fit, const LookupTable& table) {
  const auto name = [](const auto& part) { return name_of(part); };
  Head head;
  head.add("format", "remap-lookup");
  head.add("format_version", std::to_string(kFormatVersion));
  head.add("tool", std::string("remapc ") + remap::kVersion);
  head.add("id", fit.id);
  head.add("kind", kind_name(fit.mapping));
  head.add("source", fit.source);
  head.add("target", fit.target);
  if (!fit.table.sha256.empty()) head.add("fitted_table_sha256", fit.table.sha256);
  head.add("axes", joined(table.axes, ",", name));
  head.add("size",
           joined(table.axes, ",", [](const LookupAxis& a) { return std::to_string(a.positions.size()); }));
  head.add("domain_min",
           joined(table.axes, ",", [](const auto& a) { return number_text(a.positions.front()); }));
  head.add("domain_max",
           joined(table.axes, ",", [](const auto& a) { return number_text(a.positions.back()); }));
  head.add("columns", joined(table.columns, ",", name));
  add_reading(head, fit, table);
  head.add("lookup_error_max",
           joined(table.columns, ",", [](const auto& c) { return error_text(c.max_error); }));
  head.add("lookup_error_rms",
           joined(table.columns, ",", [](const auto& c) { return error_text(c.rms_error); }));
  head.add("lookup_error_samples", std::to_string(table.judged_count));

  std::string text =
      head.text() + joined(table.axes, ",", name) + "," + joined(table.columns, ",", name) + "\n";
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
