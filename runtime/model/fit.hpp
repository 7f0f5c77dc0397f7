// A fit: the learned mapping from the parameters of one BRDF model to those of another, as plain data.
// Written by remapc, stored as JSON (fit_json.hpp), evaluated by the interpreter, compiled by the emitter.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <variant>

#include "model/convention.hpp"

namespace remap {

struct Range {
  double min = 0.0;
  double max = 0.0;
  bool contains(double value) const noexcept { return value >= min && value <= max; }
  bool operator==(const Range&) const = default;
};

// One end of a conversion: a model by name (`renderer/brdf`) and what its two parameters mean.
struct ModelSide {
  std::string model;                                            // e.g. "mitsuba/ward"
  RoughnessConvention roughness = RoughnessConvention::kAlpha;  // the model's own width parameter
  std::string specular = "specular";                            // "specular" (plain scale) or "f0"
  bool operator==(const ModelSide&) const = default;
};

// Where the table has data. Outside, alpha is clamped and specular is extrapolated in proportion.
struct Domain {
  Range alpha;     // of the source, canonical width
  Range specular;  // of the source, linear, any channel
  bool operator==(const Domain&) const = default;
};

// Kind `parametric` (Sztrajman et al. 2019, section 7): alpha2 = sum of roughness[i] alpha^(i+1), and
// specular2 = k(alpha) specular1 with
//   k(alpha) = start + ramp phi(ramp_rate, alpha) + bump phi(bump_rate, alpha^2),
//   phi(rate, x) = (1 - exp(-rate x)) / rate, which is x where the rate is 0.
//
// This is the paper's c0 + c1 exp(-c2 alpha) + c3 exp(-c4 alpha^2) with c1 = -ramp / ramp_rate, c2 =
// ramp_rate, c3 = -bump / bump_rate, c4 = bump_rate, c0 = start - c1 - c3, written so that slow exponentials
// (c2 -> 0, where the published coefficients reach -512.13 + 512.75 exp(-0.00057 alpha)) stay a sum of
// numbers of order one.
struct Parametric {
  std::array<double, 4> roughness{};
  double start = 0.0;  // k at alpha = 0
  double ramp = 0.0;
  double ramp_rate = 0.0;  // >= 0
  double bump = 0.0;
  double bump_rate = 0.0;  // >= 0
  bool operator==(const Parametric&) const = default;
};

// The mapping itself. A new kind is a new alternative here; std::visit makes every consumer handle it.
using MappingKind = std::variant<Parametric>;

// Absolute errors of one output over the held-out rows.
struct ErrorFigures {
  double rms = 0.0;
  double p99 = 0.0;  // 99th percentile
  double max = 0.0;
  bool operator==(const ErrorFigures&) const = default;
};

// How the figures were made: rows of the table that trained, that were held out, and that were left out by
// status.
struct Split {
  std::uint64_t seed = 0;
  double held_out_fraction = 0.0;
  std::int64_t trained_rows = 0;
  std::int64_t held_out_rows = 0;
  std::map<std::string, std::int64_t> left_out;  // status -> rows
  bool operator==(const Split&) const = default;
};

// The table that was fitted: file name without folder, SHA-256 of its bytes, and its `# key: value` comments,
// which hold the options of the sweep.
struct TableRecord {
  std::string name;
  std::string sha256;
  std::map<std::string, std::string> comments;
  bool operator==(const TableRecord&) const = default;
};

struct Fit {
  std::string id;  // `<source>_to_<target>`, a C++ identifier
  ModelSide source;
  ModelSide target;
  Domain domain;
  MappingKind mapping;
  ErrorFigures roughness_error;  // of the target's alpha
  ErrorFigures specular_error;   // of the target's specular
  Split split;
  TableRecord table;
  std::string tool_version;
  bool operator==(const Fit&) const = default;
};

// The word for the kind in JSON and on model cards.
std::string kind_name(const MappingKind& mapping);

// `mitsuba/ward` and `mitsuba/as` to `mitsuba_ward_to_mitsuba_as`: every character that an identifier cannot
// hold becomes an underscore.
std::string converter_id(const std::string& source_model, const std::string& target_model);

// Whether `id` can name a namespace and a file: a C++ identifier that is no keyword, without a leading or
// doubled underscore.
bool is_valid_id(const std::string& id);

// Whether `name` can name a model: letters, digits and `_ - . /`, so that it can stand in file names,
// messages and generated code as it is.
bool is_valid_model(const std::string& name);

// Whether `name` can name a specular parameter: an identifier that is no name of a width parameter.
bool is_valid_specular(const std::string& name);

}  // namespace remap
