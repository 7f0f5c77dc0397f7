// Reads JSON files strictly: every value of the wrong kind is an error that names its place in the file.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "remap/error.hpp"
#include "remap/named_values.hpp"
#include "text/plain_text.hpp"

namespace remap {

// Values within values. Files of this project nest six deep; printing and destroying a value takes stack for
// each level, of which 65,000 are too many.
inline constexpr std::size_t kDeepestJson = 100;
// A megabyte of text becomes up to 20 of memory. The largest fit that ships, a warp, has 0.3.
inline constexpr std::size_t kLongestJson = std::size_t{64} << 20;
// Entries of a list: more numbers than any limit of a fit allows.
inline constexpr std::size_t kMostEntries = 100'000;
// Remarks, methods and comments are read by people, and become comments of headers.
inline constexpr std::size_t kMostLines = 1000, kLongestLine = 10'000;
// Of the words of the JSON library, which quote the text.
inline constexpr std::size_t kLongestJsonReason = 300;

// Whether brackets nest deeper than kDeepestJson. `text` need not be valid.
inline bool is_nested_too_deep(std::string_view text) {
  std::size_t depth = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_quoted && c == '\\') ++i;  // the character after it ends no text
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted) continue;
    if ((c == '[' || c == '{') && ++depth > kDeepestJson) return true;
    if ((c == ']' || c == '}') && depth > 0) --depth;
  }
  return false;
}

// Every JSON text that this project reads is read here. Throws kInput, beginning with `place`, if `text` is
// not valid JSON, and for text beyond the limits above.
inline nlohmann::ordered_json parse_json(std::string_view text, const std::string& place) {
  const auto refuse = [&](const std::string& what) { throw Error(ErrorKind::kInput, place + ": " + what); };
  if (text.size() > kLongestJson)
    refuse("has " + std::to_string(text.size() >> 20) + " MB of JSON; at most " +
           std::to_string(kLongestJson >> 20) + " MB are read");
  if (is_nested_too_deep(text))
    refuse("invalid JSON: nested deeper than " + std::to_string(kDeepestJson) + " levels");
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::ordered_json::exception& failure) {
    refuse("invalid JSON: " + plain(failure.what(), kLongestJsonReason));
  }
  return {};
}

// A JSON value and its place, such as `fit.json.domain.alpha`, which every error begins with.
class Field {
 public:
  Field(const nlohmann::ordered_json& value, std::string place) : value_(value), place_(std::move(place)) {}

  Field operator[](const std::string& key) const {
    require(value_.is_object(), "an object");
    const auto found = value_.find(key);
    if (found == value_.end()) fail("has no field \"" + key + "\"");
    return Field(*found, place_ + "." + key);
  }
  Field at(std::size_t index, std::size_t count) const {
    require(value_.is_array() && value_.size() == count, "a list of " + std::to_string(count));
    return Field(value_[index], place_ + "[" + std::to_string(index) + "]");
  }
  // Reads every entry of a list of at least `fewest` and at most `most` entries.
  template <typename Read>
  auto list(std::size_t fewest, Read read, std::size_t most = kMostEntries) const {
    require(value_.is_array() && value_.size() >= fewest, "a list of at least " + std::to_string(fewest));
    if (value_.size() > most)
      fail("has " + std::to_string(value_.size()) + " entries; at most " + std::to_string(most) +
           " are read");
    std::vector<decltype(read(*this))> entries;
    for (std::size_t i = 0; i < value_.size(); ++i) entries.push_back(read(at(i, value_.size())));
    return entries;
  }
  std::vector<double> numbers(std::size_t fewest) const {
    return list(fewest, [](const Field& entry) { return entry.number(); });
  }
  // A few lines for people.
  std::vector<std::string> texts() const {
    return list(
        0, [](const Field& entry) { return entry.line(); }, kMostLines);
  }
  // A text that is short.
  std::string line() const {
    const std::string line = text();
    if (line.size() > kLongestLine)
      fail("has a text of " + std::to_string(line.size()) + " bytes; at most " +
           std::to_string(kLongestLine) + " are read");
    return line;
  }
  const nlohmann::ordered_json& json() const { return value_; }
  const std::string& place() const { return place_; }
  std::string text() const {
    require(value_.is_string(), "a text");
    const std::string text = value_.get<std::string>();
    require(is_plain_text(text), kPlainText);
    return text;
  }
  // The value of the enumeration that the text names; `expected` lists the names.
  template <typename Value, std::size_t Count>
  Value named(const NamedValues<Value, Count>& table, const std::string& expected) const {
    const auto value = value_named(table, text());
    require(value.has_value(), expected);
    return *value;
  }
  double number() const {
    require(value_.is_number(), "a number");
    const double number = value_.get<double>();
    require(std::isfinite(number), "a finite number");
    return number;
  }
  bool is_null() const { return value_.is_null(); }
  std::int64_t count() const {
    require(value_.is_number_integer() && value_.get<std::int64_t>() >= 0, "a whole number from 0");
    return value_.get<std::int64_t>();
  }
  template <typename Value, typename Read>
  std::map<std::string, Value> dictionary(Read read) const {
    require(value_.is_object(), "an object");
    if (value_.size() > kMostLines)
      fail("has " + std::to_string(value_.size()) + " entries; at most " + std::to_string(kMostLines) +
           " are read");
    std::map<std::string, Value> entries;
    for (const auto& [key, value] : value_.items()) {
      if (!is_plain_text(key))
        fail("expected " + std::string(kPlainText) + ", found the name \"" + key + "\"");
      entries[key] = read(Field(value, place_ + "." + key));
    }
    return entries;
  }
  std::map<std::string, std::string> text_dictionary() const {
    return dictionary<std::string>([](const Field& entry) { return entry.line(); });
  }
  // Throws `place: expected EXPECTED, found VALUE`.
  void require(bool condition, const std::string& expected) const {
    if (!condition) fail("expected " + expected + ", found " + excerpt());
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::kInput, plain(place_ + ": " + what));
  }

 private:
  // What may become a comment in generated code.
  static constexpr const char* kPlainText = "a text of one line without control characters";
  std::string excerpt() const { return plain(value_.dump(), 40); }
  const nlohmann::ordered_json& value_;
  std::string place_;
};

}  // namespace remap
