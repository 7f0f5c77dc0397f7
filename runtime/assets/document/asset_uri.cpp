#include "assets/document/asset_uri.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>

#include "core/contains.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// Returns the scheme in lower case (RFC 3986, section 3.1), or an empty text for a relative reference. A
// single letter is a drive of Windows, not a scheme.
std::string scheme_of(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || !is_letter(uri.front())) return "";
  std::string scheme(uri.substr(0, colon));
  for (char& c : scheme) {
    if (!is_letter(c) && !(c >= '0' && c <= '9') && c != '+' && c != '-' && c != '.') return "";
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return scheme;
}

}  // namespace

std::string percent_decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      result += static_cast<char>(code);
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

std::string percent_encoded(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (is_letter(c) || (c >= '0' && c <= '9') || std::string_view("-._~").find(c) != std::string_view::npos)
      result += c;
    else
      result += percent_code(c);
  return result;
}

std::string uri_of_path(const std::string& path) {
  return joined(parts_between(path, '/'), "/", percent_encoded);
}

std::string stem_beside(const std::string& model, std::string_view prefix, std::string_view suffix) {
  assert(suffix.empty() || contains(kNewImageSuffixes, suffix));
  const std::size_t slash = model.find_last_of('/'), dot = model.find_last_of('.');
  const std::size_t begin = slash == std::string::npos ? 0 : slash + 1;
  const std::size_t end = dot != std::string::npos && dot >= begin ? dot : model.size();
  return model.substr(0, begin) + plain_file_name(std::string(prefix) + model.substr(begin, end - begin)) +
         std::string(suffix);
}

UriKind uri_kind(std::string_view uri) {
  const std::string scheme = scheme_of(uri);
  if (scheme == "data") return UriKind::kData;
  if (scheme.size() > 1 && scheme != "file") return UriKind::kRemote;
  std::string path = percent_decoded(uri);
  std::ranges::replace(path, '\\', '/');
  const bool is_absolute = !scheme.empty() || path.starts_with('/') || path.find('\0') != std::string::npos;
  return is_absolute ? UriKind::kAbsolute : UriKind::kFile;
}

std::string NewImageNames::free_name(const std::string& model, std::string_view suffix) {
  const std::string stem = stem_beside(model, prefix_, suffix);
  return stem + free_ending(stem, ".png");
}

std::string NewImageNames::free_ending(const std::string& stem, const char* extension) {
  for (std::size_t& number = ++numbers_[stem + extension];; ++number) {
    std::string ending = (number == 1 ? "" : "_" + std::to_string(number)) + extension;
    if (taken_.insert(stem + ending).second) return ending;
  }
}

}  // namespace remap
