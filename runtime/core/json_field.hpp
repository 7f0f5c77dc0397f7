// This file reads JSON files strictly. A value of the wrong kind is an error with its place in the file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "core/json_spans.hpp"
#include "remap/model.hpp"

namespace remap {

// Limits the text, because one megabyte needs up to 20 MB of memory. The largest fit that ships is a warp of
// 0.3 MB.
inline constexpr std::size_t kLongestJson = std::size_t{64} << 20;
// Limits the entries of a list. No valid fit has so many numbers.
inline constexpr std::size_t kMostEntries = 100'000;
// Limits remarks, methods and comments, because people read them in headers.
inline constexpr std::size_t kMostLines = 1000, kLongestLine = 10'000;
// Returns the values of a JSON text. If a key is repeated, the last field is used. Throws like SpannedJson
// (json_spans.hpp). Also throws kInput, beginning with `context`, for a text beyond kLongestJson and for a
// number that a double cannot hold.
Json parse_json(std::string_view text, const std::string& context);

// A Field is a JSON value with its place, such as `fit.json: domain.alpha`. Every error begins with the
// place.
class Field {
 public:
  // `context` is the name of the file, of which `value` is the whole content.
  Field(const Json& value, std::string context) : Field(value, std::move(context), ": ") {}

  Field operator[](const std::string& key) const;
  bool contains(std::string_view key) const { return value_.contains(key); }
  Field at(std::size_t index, std::size_t count) const;
  // Reads every entry of a list of at least `fewest` and at most `most` entries.
  template <typename Read>
  auto list(std::size_t fewest, Read read, std::size_t most = kMostEntries) const {
    const std::size_t count = entry_count(fewest, most);
    std::vector<decltype(read(*this))> entries;
    for (std::size_t i = 0; i < count; ++i) entries.push_back(read(at(i, count)));
    return entries;
  }
  std::vector<double> numbers(std::size_t fewest) const;
  // Reads a few lines written for people.
  std::vector<std::string> texts() const;
  // Reads one short text.
  std::string line() const;
  const Json& json() const { return value_; }
  const std::string& context() const { return context_; }
  std::string text() const;
  // Reads a text of any characters: the name of a file, or text that plain() makes safe to show.
  const std::string& any_text() const;
  // Reads a text that names a value of the enumeration. `expected` lists the names.
  template <typename Value, std::size_t Count>
  Value named(const NamedValues<Value, Count>& table, const std::string& expected) const {
    const auto value = value_named(table, text());
    require(value.has_value(), expected);
    return *value;
  }
  double number() const;
  // Returns the value of a flag, or false if the field is missing.
  bool flag(const std::string& key) const;
  bool is_null() const { return value_.is_null(); }
  std::int64_t count() const;
  template <typename Value, typename Read>
  std::map<std::string, Value> dictionary(Read read) const {
    std::map<std::string, Value> entries;
    for (const auto& [key, value] : entry_fields()) entries[key] = read(below(value, key));
    return entries;
  }
  std::map<std::string, std::string> text_dictionary() const;
  // Throws `place: expected EXPECTED, found VALUE` unless `condition` holds.
  void require(bool condition, const std::string& expected) const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::size_t entry_count(std::size_t fewest, std::size_t most) const;
  const Json::Object& entry_fields() const;
  Field(const Json& value, std::string context, std::string separator)
      : value_(value), context_(std::move(context)), separator_(std::move(separator)) {}
  Field below(const Json& value, const std::string& key) const {
    return Field(value, context_ + separator_ + key, ".");
  }

  const Json& value_;
  std::string context_;
  std::string separator_;  // between the context and the key of a member
};

}  // namespace remap
