// Fields that fit files and manifests share.
#pragma once

#include "remap/any_fit.hpp"
#include "remap/fit.hpp"
#include "text/json_field.hpp"

namespace remap {

// `[min, max]` with min < max. Throws kInput.
inline Range read_range(const Field& field) {
  const Range range{field.at(0, 2).number(), field.at(1, 2).number()};
  field.require(range.min < range.max, "[min, max] with min < max");
  return range;
}

// `{"model": ..., "roughness": ..., "specular": ...}`. Throws kInput for names that could not stand in
// generated code.
inline ModelSide read_side(const Field& field) {
  const std::string name = field["roughness"].text();
  const auto convention = convention_from_name(name);
  field["roughness"].require(convention.has_value(), "alpha, roughness, exponent, glossiness or squared");
  const std::string specular = field["specular"].text();
  field["specular"].require(is_valid_specular(specular), "an identifier that names no width");
  const std::string model = field["model"].text();
  field["model"].require(is_valid_model(model), "letters, digits and _ - . /");
  return {model, *convention, specular};
}

inline std::string read_id(const Field& field) {
  const std::string id = field.text();
  field.require(is_valid_id(id), "a C++ identifier without leading or doubled underscore");
  return id;
}

inline std::vector<std::string> read_texts(const Field& field) {
  return field.list(0, [](const Field& entry) { return entry.text(); });
}

// Of `remapc 1.2.3`.
inline std::string read_tool_version(const Field& field) {
  const std::string tool = field.text();
  field.require(tool.starts_with("remapc "), "remapc and its version");
  return tool.substr(7);
}

// Whether the root of a fit file is that of a fit of whole materials: its ends name their workflows.
inline bool is_of_materials(const Field& root) {
  return root.json().contains("source") && root["source"].json().contains("workflow");
}

// The fit of kind `warp` of a root whose format has been looked at (warp_json.cpp). Throws kInput.
WarpMapFit read_warp_fit(const Field& root);

// Throws kInput where the root of a file is not that of a fit of kFitFormatVersion.
inline void require_fit_format(const Field& root) {
  if (root["format"].text() != "remap-fit") root.fail("not a fit file (\"format\" must be \"remap-fit\")");
  const std::int64_t version = root["version"].count();
  if (version != kFitFormatVersion)
    root.fail("has format version " + std::to_string(version) + "; this program reads version " +
              std::to_string(kFitFormatVersion));
}

// The fit of width and specular whose file has that root. Throws kInput.
Fit read_fit(const Field& root);

}  // namespace remap
