#include "remap/model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/contains.hpp"

namespace remap {
namespace {

bool is_identifier_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

// These C++20 keywords ([lex.key]) cannot name a namespace.
constexpr std::array<std::string_view, 92> kKeywords = {
    "alignas",     "alignof",  "and",        "and_eq",    "asm",       "auto",         "bitand",
    "bitor",       "bool",     "break",      "case",      "catch",     "char",         "char16_t",
    "char32_t",    "char8_t",  "class",      "co_await",  "co_return", "co_yield",     "compl",
    "concept",     "const",    "const_cast", "consteval", "constexpr", "constinit",    "continue",
    "decltype",    "default",  "delete",     "do",        "double",    "dynamic_cast", "else",
    "enum",        "explicit", "export",     "extern",    "false",     "float",        "for",
    "friend",      "goto",     "if",         "inline",    "int",       "long",         "mutable",
    "namespace",   "new",      "noexcept",   "not",       "not_eq",    "nullptr",      "operator",
    "or",          "or_eq",    "private",    "protected", "public",    "register",     "reinterpret_cast",
    "requires",    "return",   "short",      "signed",    "sizeof",    "static",       "static_assert",
    "static_cast", "struct",   "switch",     "template",  "this",      "thread_local", "throw",
    "true",        "try",      "typedef",    "typeid",    "typename",  "union",        "unsigned",
    "using",       "virtual",  "void",       "volatile",  "wchar_t",   "while",        "xor",
    "xor_eq"};

// These names are in use already. They are namespaces of the standard ([namespace.future]: std and std1,
// posix), the namespace of every header, and macros of systems and of included headers.
constexpr std::array<std::string_view, 9> kTakenNames = {"posix", "remap", "linux",    "unix", "i386",
                                                         "NULL",  "NAN",   "INFINITY", "EOF"};

bool is_taken(std::string_view id) {
  const bool is_std =
      id.starts_with("std") && id.find_first_not_of("0123456789", 3) == std::string_view::npos;
  return is_std || contains(kTakenNames, id) || contains(kKeywords, id);
}

std::string identifier(const std::string& model) {
  std::string text;
  for (const char c : model) {
    if (is_identifier_character(c))
      text += c;
    else if (!text.empty() && text.back() != '_')
      text += '_';
  }
  return text;
}

}  // namespace

std::string converter_id(const std::string& source_model, const std::string& target_model) {
  return identifier(source_model) + "_to_" + identifier(target_model);
}

bool is_valid_id(const std::string& id) {
  if (id.empty() || id.size() > kLongestName || id.find("__") != std::string::npos || is_taken(id))
    return false;
  const char first = id.front();
  if (first == '_' || (first >= '0' && first <= '9')) return false;
  return std::ranges::all_of(id, [](char c) { return is_identifier_character(c) || c == '_'; });
}

bool is_valid_model(const std::string& name) {
  const auto allowed = [](char c) {
    return is_identifier_character(c) || c == '_' || c == '-' || c == '.' || c == '/';
  };
  return !name.empty() && name.size() <= kLongestName && std::ranges::all_of(name, allowed);
}

bool is_valid_specular(const std::string& name) {
  return is_valid_id(name) && !encoding_from_name(name).has_value();
}

double to_alpha(RoughnessEncoding convention, double own) {
  switch (convention) {
    case RoughnessEncoding::kAlpha:
      return own;
    case RoughnessEncoding::kRoughness:
      return own * own;
    case RoughnessEncoding::kExponent:
      return std::sqrt(2.0 / (own + 2.0));
    case RoughnessEncoding::kGlossiness:
      return (1.0 - own) * (1.0 - own);
    case RoughnessEncoding::kSquared:
      return std::sqrt(own);
  }
  return own;
}

double from_alpha(RoughnessEncoding convention, double alpha) {
  switch (convention) {
    case RoughnessEncoding::kAlpha:
      return alpha;
    case RoughnessEncoding::kRoughness:
      return std::sqrt(alpha);
    case RoughnessEncoding::kExponent:
      return 2.0 / (alpha * alpha) - 2.0;
    case RoughnessEncoding::kGlossiness:
      return 1.0 - std::sqrt(alpha);
    case RoughnessEncoding::kSquared:
      return alpha * alpha;
  }
  return alpha;
}

}  // namespace remap
