// This file describes BRDF models as ends of a conversion: names, the meaning of parameters, and ranges.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// The following functions give the names of enumerators in files and on the command line.

template <typename Value>
struct NamedValue {
  Value value;
  std::string_view name;
};

// A NamedValues table holds each enumerator once.
template <typename Value, std::size_t Count>
using NamedValues = std::array<NamedValue<Value>, Count>;

// Returns the name, or an empty text if the value is not in the table.
template <typename Value, std::size_t Count>
constexpr std::string_view name_of(const NamedValues<Value, Count>& table, Value value) noexcept {
  for (const NamedValue<Value>& entry : table)
    if (entry.value == value) return entry.name;
  return {};
}

template <typename Value, std::size_t Count>
constexpr std::optional<Value> value_named(const NamedValues<Value, Count>& table,
                                           std::string_view name) noexcept {
  for (const NamedValue<Value>& entry : table)
    if (entry.name == name) return entry.value;
  return std::nullopt;
}

// Returns all names in the order of the table.
template <typename Value, std::size_t Count>
std::vector<std::string> names_of(const NamedValues<Value, Count>& table) {
  std::vector<std::string> names;
  for (const NamedValue<Value>& entry : table) names.emplace_back(entry.name);
  return names;
}

// A Range is a closed interval.
struct Range {
  double min = 0.0;
  double max = 0.0;
  bool contains(double value) const noexcept { return value >= min && value <= max; }
  bool operator==(const Range&) const = default;
};

// A RoughnessEncoding is a parameter for the microfacet width, as BRDF models have it. Each encoding is an
// invertible function of alpha. Sweeps and fits use alpha.

enum class RoughnessEncoding {
  kAlpha,       // the microfacet width itself, (0, 1]
  kRoughness,   // perceptual roughness, sqrt(alpha) (Burley 2012; glTF 2.0; Cycles since Blender 2.80)
  kExponent,    // Phong exponent, 2 / alpha^2 - 2 (Walter et al. 2007, section 5.2)
  kGlossiness,  // 1 - sqrt(alpha)
  kSquared,     // alpha^2, as the formulas of microfacet distributions contain it
};

// These functions convert the model's own parameter to alpha, and alpha to the parameter. They are inverse up
// to rounding for alpha in (0, 1]. The exponent of alpha 0 is infinite.
double to_alpha(RoughnessEncoding convention, double own);
double from_alpha(RoughnessEncoding convention, double alpha);

// These names are used in fits and tables. Generated headers use them for the parameter.
inline constexpr NamedValues<RoughnessEncoding, 5> kRoughnessEncodings = {
    {{RoughnessEncoding::kAlpha, "alpha"},
     {RoughnessEncoding::kRoughness, "roughness"},
     {RoughnessEncoding::kExponent, "exponent"},
     {RoughnessEncoding::kGlossiness, "glossiness"},
     {RoughnessEncoding::kSquared, "squared"}}};
inline std::string_view encoding_name(RoughnessEncoding convention) {
  return name_of(kRoughnessEncodings, convention);
}
inline std::optional<RoughnessEncoding> encoding_from_name(std::string_view name) {
  return value_named(kRoughnessEncodings, name);
}
inline std::vector<std::string> convention_names() { return names_of(kRoughnessEncodings); }

// The following types hold the ends of a conversion and their names.

// A ModelSide is one end of a conversion: a model and the meaning of its two parameters.
struct ModelSide {
  std::string model;                                        // for example "mitsuba/ward"
  RoughnessEncoding roughness = RoughnessEncoding::kAlpha;  // the model's own width parameter
  std::string specular = "specular";                        // "specular" (plain scale) or "f0"
  bool operator==(const ModelSide&) const = default;
};

// Returns an id such as `mitsuba_ward_to_mitsuba_as` for `mitsuba/ward` and `mitsuba/as`. Characters that an
// identifier cannot contain become underscores.
std::string converter_id(const std::string& source_model, const std::string& target_model);

// Limits the letters of an id and of a model. File systems allow 255 letters in a name, and unfinished files
// and extensions need some of them.
inline constexpr std::size_t kLongestName = 128;

// This is the rule for ids as messages state it.
inline constexpr const char* kIdRule =
    "at most 128 letters, digits and single underscores, beginning with a letter, but no C++ keyword or "
    "macro";

// Returns true if `id` follows kIdRule, so that it can name a namespace and a file. C++ reserves its
// keywords, `std` and the macros of its headers.
bool is_valid_id(const std::string& id);

// Returns true if `name` can be a model in file names, messages and generated code. It must have only
// letters, digits and `_ - . /`, at most kLongestName of them.
bool is_valid_model(const std::string& name);

// Returns true if `name` can be a specular parameter: an identifier other than a width parameter's.
bool is_valid_specular(const std::string& name);

}  // namespace remap
