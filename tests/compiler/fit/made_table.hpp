// This file makes tables from a known parametric form, and fits of them. No renderer knows their models,
// because otherwise fits would compare pictures, which takes nine seconds.
#pragma once

#include <string>
#include <vector>

#include "fit/fit_table.hpp"
#include "lower/evaluate.hpp"
#include "lower/interpreter.hpp"
#include "table/table.hpp"

namespace made_table {

using namespace remap;

inline Table table_of(const Parametric& form, double low = 0.02, double high = 1.0, int widths = 25) {
  Table table;
  table.name = "made.csv";
  table.source = {"made/ward", RoughnessEncoding::kAlpha, "specular"};
  table.target = {"made/as", RoughnessEncoding::kAlpha, "f0"};
  std::size_t line = 2;
  for (int i = 0; i < widths; ++i) {
    for (int j = 1; j <= 6; ++j) {
      const double alpha = low + (high - low) * i / (widths - 1), specular = 0.15 * j;
      const MappedTexel texel = evaluate_mapping(form, alpha, specular);
      table.rows.push_back({alpha, specular, texel.alpha, texel.specular, 0.0, RowStatus::kOk, line++});
    }
  }
  return table;
}

inline Fit fit_of(const Table& table, std::uint64_t seed = 1, const std::string& form = "paper") {
  FitOptions options;
  options.kind = "parametric";
  options.seed = seed;
  options.form = form;
  return fit_table(table, table_text(table), options);
}

// Returns a mapping of the paper's form.
inline Parametric paper_form(const std::vector<double>& quartic, const AlphaCurve& slope) {
  return {{quartic}, {{1, slope}}};
}
inline const Parametric kStraight = paper_form({1.0, 0.0, 0.0, 0.0}, {0.7, 0.0, 0.0, 0.0, 0.0, 0.0});

inline double slope_at(const Fit& fit, double alpha) {
  return curve_value(std::get<Parametric>(fit.mapping).specular[0].factor, alpha);
}

}  // namespace made_table
