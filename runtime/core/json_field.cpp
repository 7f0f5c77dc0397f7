#include "core/json_field.hpp"

#include <cmath>

#include "core/plain_text.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// Of the words of the JSON library, which quote the text.
constexpr std::size_t kLongestReason = 300;
constexpr std::size_t kExcerpt = 40;
// What may become a comment in generated code.
constexpr const char* kPlainText = "a text of one line without control characters";

}  // namespace

bool is_nested_too_deep(std::string_view text) {
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

Json parse_json(std::string_view text, const std::string& place) {
  const auto refuse = [&](const std::string& what) { throw Error(ErrorKind::kInput, place + ": " + what); };
  if (text.size() > kLongestJson)
    refuse("has " + std::to_string(text.size() >> 20) + " MB of JSON; at most " +
           std::to_string(kLongestJson >> 20) + " MB are read");
  if (is_nested_too_deep(text))
    refuse("invalid JSON: nested deeper than " + std::to_string(kDeepestJson) + " levels");
  std::variant<Json, JsonFault> parsed = json_of(text);
  if (const auto* fault = std::get_if<JsonFault>(&parsed))
    refuse("invalid JSON " + plain(fault->reason, kLongestReason));
  return std::get<Json>(std::move(parsed));
}

Field Field::operator[](const std::string& key) const {
  require(value_.fields() != nullptr, "an object");
  const Json* found = value_.find(key);
  if (found == nullptr) fail("has no field \"" + key + "\"");
  return Field(*found, place_ + "." + key);
}

Field Field::at(std::size_t index, std::size_t count) const {
  const Json::List* entries = value_.entries();
  require(entries != nullptr && entries->size() == count, "a list of " + std::to_string(count));
  return Field((*entries)[index], place_ + "[" + std::to_string(index) + "]");
}

std::size_t Field::entry_count(std::size_t fewest, std::size_t most) const {
  require(value_.entries() != nullptr && value_.size() >= fewest,
          "a list of at least " + std::to_string(fewest));
  if (value_.size() > most)
    fail("has " + std::to_string(value_.size()) + " entries; at most " + std::to_string(most) + " are read");
  return value_.size();
}

std::vector<double> Field::numbers(std::size_t fewest) const {
  return list(fewest, [](const Field& entry) { return entry.number(); });
}

std::vector<std::string> Field::texts() const {
  return list(
      0, [](const Field& entry) { return entry.line(); }, kMostLines);
}

std::string Field::line() const {
  const std::string line = text();
  if (line.size() > kLongestLine)
    fail("has a text of " + std::to_string(line.size()) + " bytes; at most " + std::to_string(kLongestLine) +
         " are read");
  return line;
}

std::string Field::text() const {
  require(is_plain_text(any_text()), kPlainText);
  return any_text();
}

const std::string& Field::any_text() const {
  require(value_.text() != nullptr, "a text");
  return *value_.text();
}

double Field::number() const {
  const std::optional<double> number = value_.number();
  require(number.has_value(), "a number");
  require(std::isfinite(*number), "a finite number");
  return *number;
}

bool Field::flag(const std::string& key) const {
  if (!contains(key)) return false;
  const Field field = (*this)[key];
  field.require(field.value_.boolean() != nullptr, "true or false");
  return *field.value_.boolean();
}

std::int64_t Field::count() const {
  const std::optional<std::int64_t> count = value_.whole();
  require(count && *count >= 0, "a whole number from 0");
  return *count;
}

const Json::Object& Field::entry_fields() const {
  require(value_.fields() != nullptr, "an object");
  if (value_.size() > kMostLines)
    fail("has " + std::to_string(value_.size()) + " entries; at most " + std::to_string(kMostLines) +
         " are read");
  for (const auto& [key, value] : *value_.fields())
    if (!is_plain_text(key)) fail("expected " + std::string(kPlainText) + ", found the name \"" + key + "\"");
  return *value_.fields();
}

std::map<std::string, std::string> Field::text_dictionary() const {
  return dictionary<std::string>([](const Field& entry) { return entry.line(); });
}

void Field::require(bool condition, const std::string& expected) const {
  if (!condition) fail("expected " + expected + ", found " + plain(value_.dump(), kExcerpt));
}

void Field::fail(const std::string& what) const {
  throw Error(ErrorKind::kInput, plain(place_ + ": " + what));
}

}  // namespace remap
