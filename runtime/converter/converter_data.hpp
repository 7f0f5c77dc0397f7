// A converter of width and specular as data: the section of a fit file that texremap runs and remapc emits,
// and the file that holds it for many.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "converter/compact_form.hpp"
#include "remap/converter.hpp"

namespace remap {

// A texel and what the fit gives for it in double precision, with the error that a converter may have. Width
// and specular are the models' own parameters.
struct GoldenTexel {
  float width = 0.0f, specular = 0.0f;
  float width_out = 0.0f, specular_out = 0.0f;
  float width_within = 0.0f, specular_within = 0.0f;
  bool operator==(const GoldenTexel&) const = default;
};

struct ConverterData {
  // Figures of the fit have two digits, rounded up; SSIM has three; pictures have one decimal. Ranges are
  // rounded to float.
  ConverterInfo info;
  CompactForm form;
  // How far it may be from the fit over the domain, in target alpha and target specular; 0 where the form is
  // the fit.
  double alpha_bound = 0.0, specular_bound = 0.0;
  std::vector<GoldenTexel> golden;  // over and beyond the domain, with its edges
  bool operator==(const ConverterData&) const = default;
};

// A file of converters, in the order given: the same converters give the same bytes, and floats are read back
// exactly.
std::string converters_to_json(const std::vector<ConverterData>& converters);
// Throws kInput, opened by `context`, for anything else than such a file.
std::vector<ConverterData> converters_from_json(std::string_view text, const std::string& context);

}  // namespace remap
