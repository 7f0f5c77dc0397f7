#include "discovery/shown_path.hpp"

#include <string_view>

namespace remap {

std::string shown(const std::filesystem::path& path) {
  constexpr std::string_view kHexDigits = "0123456789abcdef";
  std::string text;
  for (const char c : path.string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n')
      text += "\\n";
    else if (byte < 0x20 || byte == 0x7f)
      text += {'\\', 'x', kHexDigits[byte >> 4], kHexDigits[byte & 15u]};
    else
      text += c;
  }
  return text;
}

}  // namespace remap
