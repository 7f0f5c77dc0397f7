// Code that headers hold word for word as text: the files of runtime/convert/code, runtime/workflow/code and
// runtime/warp/code, compiled in.
#pragma once

#include <string_view>

namespace remapc {

// The domain rule of converters of width and specular.
extern const std::string_view kDomainText;
extern const std::string_view kScaleText;
extern const std::string_view kProportionalText;
extern const std::string_view kTermsText;

// Whole materials.
extern const std::string_view kFloatsText;
extern const std::string_view kConventionsText;
extern const std::string_view kRowsText;
extern const std::string_view kWidthText;
extern const std::string_view kMetallicToSpecularText;
extern const std::string_view kSpecularTexelsText;
extern const std::string_view kProjectionText;
extern const std::string_view kEquation3Text;
extern const std::string_view kKhronosText;
extern const std::string_view kLearnedText;

extern const std::string_view kAppearanceText;
extern const std::string_view kSeparableText;
extern const std::string_view kQuadraticText;
extern const std::string_view kBlendedText;
extern const std::string_view kCopiedText;
extern const std::string_view kWarpBlockText;

}  // namespace remapc
