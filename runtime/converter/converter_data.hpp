// This file holds converters of width and specular as data. A fit file has one converter, which texremap runs
// and remapc emits. Another kind of file has many converters.
// Its functions read and write parts of both kinds as JSON. The readers throw kInput.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "converter/compact_form.hpp"
#include "core/json_field.hpp"
#include "remap/converter.hpp"

namespace remap {

// A GoldenTexel is a texel, the result of the fit in double precision, and the error that a converter may
// have. Width and specular are the models' own parameters.
struct GoldenTexel {
  float width = 0.0f, specular = 0.0f;
  float width_out = 0.0f, specular_out = 0.0f;
  float width_within = 0.0f, specular_within = 0.0f;
  bool operator==(const GoldenTexel&) const = default;
};

struct ConverterData {
  // The errors of the fit have two digits, rounded up. SSIM has three digits, and picture differences have
  // one decimal. Ranges are rounded to float.
  ConverterInfo info;
  CompactForm form;
  // Over the domain, target alpha and target specular differ from the fit by at most these bounds. They are 0
  // if the form is the fit itself.
  double alpha_bound = 0.0, specular_bound = 0.0;
  std::vector<GoldenTexel> golden;  // texels inside of the domain, on its edge and beyond
  bool operator==(const ConverterData&) const = default;
};

// Returns a file of converters in order. Equal converters give equal bytes, and floats read back exactly.
std::string converters_to_json(const std::vector<ConverterData>& converters);
// Reads the text of converters_to_json(). Throws kInput, beginning with `context`, for any other text.
std::vector<ConverterData> converters_from_json(std::string_view text, const std::string& context);

// This program reads and writes this version of fit files.
inline constexpr int kFitFormatVersion = 4;

// Throws kInput if `root` is not the root of a fit file of this version.
void require_fit_file(const Field& root);
// Returns true if the file holds a fit of whole materials. Its ends are workflows.
bool is_of_materials(const Field& root);

// Reads `[min, max]` with min < max.
Range read_range(const Field& field);

// Reads `{"model": ..., "roughness": ..., "specular": ...}`. The names must be valid in generated code.
ModelSide read_side(const Field& field);
Json side_json(const ModelSide& side);
Json domain_json(const ConverterInfo& info);
// Returns the errors of the fit. An unknown error becomes null.
Json errors_json(const ConverterInfo& info);
// Returns the SSIM of the fit's spheres, or null if it is unknown.
Json ssim_json(const ConverterInfo& info);
std::string read_id(const Field& field);
std::string read_model(const Field& field);

// Reads the version from a text such as `remapc 1.2.3`.
std::string read_tool_version(const Field& field);

// Returns `value`. Throws kNumeric if it is not finite.
double finite(double value);

// Returns the section `converter` of a fit file. Throws kNumeric if a number is not finite.
std::string converter_to_json(const ConverterData& converter);
ConverterData read_converter(const Field& field);
// Reads the converter of the fit file with this root. Returns nothing if the fit has no converter because it
// could not be lowered. Throws kInput if the file has no section `converter`.
std::optional<ConverterData> read_fitted_converter(const Field& root);
// Messages about files without a converter end with this advice.
inline constexpr const char* kMakeAgain = "run remapc fit again, or chain, invert or build";

}  // namespace remap
