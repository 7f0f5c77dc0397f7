// The formulas of workflow conversions as text: the files of runtime/workflow/code, compiled in.
#pragma once

#include <string_view>

namespace remapc {

extern const std::string_view kFloatsText;
extern const std::string_view kRowsText;
extern const std::string_view kMetallicToSpecularText;
extern const std::string_view kSpecularTexelsText;
extern const std::string_view kProjectionText;
extern const std::string_view kEquation3Text;
extern const std::string_view kKhronosText;
extern const std::string_view kLearnedText;

}  // namespace remapc
