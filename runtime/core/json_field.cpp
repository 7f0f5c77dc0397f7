#include "core/json_field.hpp"

#include <charconv>
#include <cmath>
#include <unordered_map>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr std::size_t kExcerpt = 40;
// These words describe a text that may become a comment in generated code.
constexpr const char* kPlainText = "a text of one line without control characters";

Json value_of(SpanValue span, const std::string& context);

Json number_of(std::string_view text, const std::string& context) {
  const char* const end = text.data() + text.size();
  const auto is_read_as = [&](auto& value) {
    const auto read = std::from_chars(text.data(), end, value);
    return read.ec == std::errc() && read.ptr == end;
  };
  std::int64_t whole = 0;
  std::uint64_t large = 0;
  if (is_read_as(whole)) return whole;
  if (is_read_as(large)) return large;
  const std::optional<double> number = parse_number(text);
  if (!number) throw input_error(context + ": a number that is too large: " + plain(text, kExcerpt));
  return *number;
}

Json object_of(SpanValue span, const std::string& context) {
  Json::Object fields;
  std::unordered_map<std::string, std::size_t> places;
  for (const SpanValue member : span.children()) {
    const auto [found, is_new] = places.try_emplace(member.key(), fields.size());
    Json value = value_of(member, context);
    if (is_new)
      fields.emplace_back(found->first, std::move(value));
    else
      fields[found->second].second = std::move(value);
  }
  return fields;
}

Json value_of(SpanValue span, const std::string& context) {
  switch (span.kind()) {
    case SpanKind::kNull:
      return {};
    case SpanKind::kBoolean:
      return span.raw() == "true";
    case SpanKind::kNumber:
      return number_of(span.raw(), context);
    case SpanKind::kText:
      return *span.text();
    case SpanKind::kObject:
      return object_of(span, context);
    case SpanKind::kList:
      break;
  }
  Json::List entries;
  entries.reserve(span.size());
  for (const SpanValue entry : span.children()) entries.push_back(value_of(entry, context));
  return entries;
}

}  // namespace

Json parse_json(std::string_view text, const std::string& context) {
  if (text.size() > kLongestJson)
    throw input_error(context + ": has " + std::to_string(text.size() >> 20) + " MB of JSON; at most " +
                      std::to_string(kLongestJson >> 20) + " MB can be read");
  return value_of(SpannedJson(text, context).root(), context);
}

Field Field::operator[](const std::string& key) const {
  require(value_.fields() != nullptr, "an object");
  const Json* found = value_.find(key);
  if (found == nullptr) fail("has no field \"" + key + "\"");
  return below(*found, key);
}

Field Field::at(std::size_t index, std::size_t count) const {
  const Json::List* entries = value_.entries();
  require(entries != nullptr && entries->size() == count, "a list of " + std::to_string(count));
  return Field((*entries)[index], context_ + "[" + std::to_string(index) + "]", ".");
}

std::size_t Field::entry_count(std::size_t fewest, std::size_t most) const {
  require(value_.entries() != nullptr && value_.size() >= fewest,
          "a list of at least " + std::to_string(fewest) + (fewest == 1 ? " entry" : " entries"));
  if (value_.size() > most)
    fail("has " + std::to_string(value_.size()) + " entries, but at most " + std::to_string(most) +
         " can be read");
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
    fail("has a text of " + std::to_string(line.size()) + " bytes, but at most " +
         std::to_string(kLongestLine) + " can be read");
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
    fail("has " + std::to_string(value_.size()) + " entries, but at most " + std::to_string(kMostLines) +
         " can be read");
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

void Field::fail(const std::string& what) const { throw input_error(plain(context_ + ": " + what)); }

}  // namespace remap
