// Short forms: conversions of at most five constants, one line for each output, for importers that take a
// line and no header. The same expression is searched for its constants, judged, and written in every
// language.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "remap/model.hpp"

namespace remap {

enum class ShortOp { kNumber, kInput, kAdd, kSubtract, kMultiply, kDivide, kMin, kMax, kPower };

// A number, an input, or an operation on two terms.
struct ShortExpression {
  ShortOp op = ShortOp::kNumber;
  double number = 0.0;
  std::string input;
  std::vector<ShortExpression> terms;

  double value(const std::map<std::string, double>& inputs) const;
};

// What is converted into what. Colors are linear, and each channel is converted alone.
enum class ShortKind {
  kWidths,          // alpha and specular of one hub model to those of another
  kExponent,        // an exponent and Ks of a lobe that is not normalised to roughness, F0 and base color
  kExponentNormal,  // the same of a normalised lobe
  kToExponent,      // roughness, F0, base color and metallic to an exponent, Ks and Kd
};
inline constexpr NamedValues<ShortKind, 4> kShortKinds = {
    {{ShortKind::kWidths, "widths"},
     {ShortKind::kExponent, "exponent"},
     {ShortKind::kExponentNormal, "exponent-normalised"},
     {ShortKind::kToExponent, "to-exponent"}}};

// How specular changes with alpha, of kWidths. e and f are constants.
enum class ShortStrength { kLine, kSquare, kOverLine, kOverSquare };
inline constexpr NamedValues<ShortStrength, 4> kShortStrengths = {
    {{ShortStrength::kLine, "e + f alpha"},
     {ShortStrength::kSquare, "e + f alpha^2"},
     {ShortStrength::kOverLine, "e / (1 + f alpha)"},
     {ShortStrength::kOverSquare, "e / (1 + f alpha^2)"}}};

// Errors of a rule over materials and lights: RMSE of display values in percent and SSIM, means over spheres
// under environments; and the median error relative to the source under the light at 60 degrees.
struct ShortFigures {
  double rmse = 0.0, ssim = 0.0, relative = 0.0;
};

struct ShortForm {
  std::string id;  // `mitsuba_ward_to_mitsuba_ggx`
  std::string source, target;
  ShortKind kind = ShortKind::kWidths;
  ShortStrength strength = ShortStrength::kLine;
  std::vector<double> constants;
  // Of the materials and lights that had no say in the constants: of the form, the best possible parameters,
  // copied numbers (of an exponent F0 0.04 and the fourth root), and the compiled converter.
  ShortFigures figures, best, copied;
  std::optional<ShortFigures> compiled;
};

struct ShortOutput {
  std::string name;                 // `alpha`
  std::vector<std::string> inputs;  // of the line, in order; of an earlier output its name
  ShortExpression value;
};

// The lines of a form, in the order in which they are evaluated.
std::vector<ShortOutput> outputs_of(const ShortForm& form);

// The alpha and specular of the target for those of the source, both as converters have them: exponents as
// the alpha that stands for them, a channel at a time. Alpha is kept within 0.001 and 1.
struct ShortTexel {
  double alpha = 0.0, specular = 0.0;
};
ShortTexel converted(const std::vector<ShortOutput>& outputs, ShortKind kind, double alpha, double specular);

// The number of constants that outputs_of() needs.
std::size_t constant_count(ShortKind kind);

// In a folder of fits.
inline constexpr const char* kShortFormsName = "short/forms.json";
std::string short_forms_json(const std::vector<ShortForm>& forms);
// Throws kInput, beginning with `place`.
std::vector<ShortForm> short_forms_of(const std::string& text, const std::string& place);

}  // namespace remap
