// What stands around the code of every generated header, whatever it converts.
#pragma once

#include <string>
#include <string_view>

namespace remapc {

// After the includes, and at the end.
inline constexpr std::string_view kBeforeCode =
    R"(#if defined(__clang__)  // a loop that cannot be vectorised under the user's flags is no fault
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wpass-failed"
#endif)";
inline constexpr std::string_view kBehindCode = R"(#if defined(__clang__)
#pragma clang diagnostic pop
#endif)";

// `REMAP_GENERATED_A_TO_B_HPP`.
inline std::string guard_of(const std::string& id) {
  std::string upper = id;
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return "REMAP_GENERATED_" + upper + "_HPP";
}

}  // namespace remapc
