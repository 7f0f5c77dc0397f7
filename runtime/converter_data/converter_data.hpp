// A converter of width and specular as data: what texremap needs of a fit, and the file that holds it for
// many.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lower/lowered.hpp"
#include "remap/fit.hpp"

namespace remap {

// A texel and what the fit gives for it in double precision, with the error that a converter may have. Width
// and specular are the models' own parameters.
struct GoldenTexel {
  float width = 0.0f, specular = 0.0f;
  float width_out = 0.0f, specular_out = 0.0f;
  float width_within = 0.0f, specular_within = 0.0f;
  bool operator==(const GoldenTexel&) const = default;
};

// Texels over and beyond the domain of the fit, with its edges. The errors are bounds of target alpha and,
// within the domain, of target specular.
std::vector<GoldenTexel> golden_texels(const Fit& fit, double alpha_error, double specular_error);

struct ConverterData {
  std::string id;
  ModelSide source, target;
  Range roughness, specular;  // covered, in the source's own parameters
  // Of the fit, as in ConverterInfo; two digits, rounded up.
  std::optional<double> roughness_rms_error, specular_rms_error, image_rms_error;
  std::optional<double> ssim;  // as in ConverterInfo; three digits
  // The polynomials of a lowered fit, its limits and regimes (lower/lowered.hpp).
  struct Series {
    float alpha_from = 0.0f, specular_from = 0.0f;
    PiecewisePolynomial polynomial;
    bool operator==(const Series&) const = default;
  };
  PiecewisePolynomial alpha_polynomial, specular_polynomial;
  std::optional<float> alpha_limit, specular_limit;
  float mapping_to = 0.0f;       // beside `wide`
  std::optional<Series> wide;    // target specular
  std::optional<Series> bright;  // target alpha
  std::vector<GoldenTexel> golden;
  bool operator==(const ConverterData&) const = default;
};

// What `lowered` makes of `fit`.
ConverterData converter_data(const Fit& fit, const Lowered& lowered);

// A file of converters, in the order given: the same converters give the same bytes, and floats are read back
// exactly.
std::string converters_to_json(const std::vector<ConverterData>& converters);
// Throws kInput, opened by `place`, for anything else than such a file.
std::vector<ConverterData> converters_from_json(std::string_view text, const std::string& place);

}  // namespace remap
