// This file holds converters of width and specular as data. A fit file has one converter, which texremap runs
// and remapc emits. Another kind of file has many converters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "converter/compact_form.hpp"
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

}  // namespace remap
