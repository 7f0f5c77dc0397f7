#include "core/safe_relative.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

fs::path checked(const std::string& text, const std::string& context, std::string fault) {
  if (!fault.empty()) throw input_error(context + ": \"" + plain(text) + "\" " + fault);
  return text;
}

}  // namespace

std::string fault_of_relative(const std::string& text) {
  const fs::path path = text;
  if (path.has_root_path()) return "is an absolute path";
  if (std::ranges::find(path, "..") != path.end()) return "leads out of its folder";
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  return std::ranges::any_of(text, is_control) ? "has control characters" : "";
}

fs::path safe_relative(const std::string& text, const std::string& context) {
  return checked(text, context, fault_of_relative(text));
}

fs::path safe_name(const std::string& text, const std::string& context) {
  const std::string fault = fault_of_relative(text);
  return checked(text, context, fault.empty() && fs::path(text).has_parent_path() ? "is not a name" : fault);
}

bool is_own_name(const fs::path& name) {
  constexpr std::string_view kOwn = ".texremap";
  const std::string text = name.string().substr(0, kOwn.size());
  return std::ranges::equal(text, kOwn,
                            [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

}  // namespace remap
