// A fit as a grid of samples, for tools that take tables and nothing else: what a .cube file is for colors.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/rows/regression.hpp"
#include "remap/fit.hpp"

namespace remapc {

enum class LookupOutput { kBoth, kRoughness, kSpecular };

struct LookupOptions {
  std::size_t size = 65;           // samples over the source's width
  std::size_t specular_size = 17;  // samples over its specular, where the table has that axis
  LookupOutput output = LookupOutput::kBoth;
  // Widths are alpha in place of the models' own parameters. Even steps of an exponent would put most
  // materials into the first step.
  bool canonical = false;
  unsigned jobs = 0;  // threads; 0: one a processor. The table does not depend on it
};

struct LookupAxis {
  std::string name;               // e.g. `source_roughness`, `source_specular`
  std::vector<double> positions;  // evenly spaced, with both ends of the domain
};

struct LookupColumn {
  std::string name;            // e.g. `target_alpha`, `target_f0`, `target_f0_factor`
  std::vector<double> values;  // one for each grid point, the last axis fastest
  // Errors of linear lookup against the fit, in the column's own unit, measured at 16 steps of each cell of
  // one axis and 8 x 8 steps of two, grid points included. The largest error is underestimated by 2 % at most
  // where the fit bends evenly within a cell.
  double rms_error = 0.0, max_error = 0.0;
};

// One axis, width, where no column depends on specular; else two, width and specular.
//
// With two axes the specular column holds the target's specular. With one it holds the factor to specular,
// the value of the fit for a specular of 1, and its name ends with `_factor`.
struct LookupTable {
  std::vector<LookupAxis> axes;
  std::vector<LookupColumn> columns;
  std::size_t judged_count = 0;  // samples from which the errors were measured
};

// A table holds at most this many grid points.
inline constexpr std::size_t kMostLookupRows = std::size_t{1} << 20;

// Samples `fit` with evaluate_texel() (interpreter.hpp). Throws kUsage for a size below 2 or more than
// kMostLookupRows grid points, kNumeric where the fit gives no finite number, and what `progress` throws.
LookupTable sample_fit(const remap::Fit& fit, const LookupOptions& options, const FitProgress& progress = {});

// The CSV text of a table: `# key: value` lines that describe it, a header row with the names of axes and
// columns, one row for each grid point. `remapc export --help` lists the keys.
std::string lookup_text(const remap::Fit& fit, const LookupTable& table);

}  // namespace remapc
