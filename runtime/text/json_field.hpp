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

namespace remap {

// Throws kInput, beginning with `place`, if `text` is not valid JSON.
inline nlohmann::ordered_json parse_json(std::string_view text, const std::string& place) {
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::ordered_json::exception& failure) {
    throw Error(ErrorKind::kInput, place + ": invalid JSON: " + failure.what());
  }
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
  // Reads every entry of a list of at least `fewest` entries.
  template <typename Read>
  auto list(std::size_t fewest, Read read) const {
    require(value_.is_array() && value_.size() >= fewest, "a list of at least " + std::to_string(fewest));
    std::vector<decltype(read(*this))> entries;
    for (std::size_t i = 0; i < value_.size(); ++i) entries.push_back(read(at(i, value_.size())));
    return entries;
  }
  std::vector<double> numbers(std::size_t fewest) const {
    return list(fewest, [](const Field& entry) { return entry.number(); });
  }
  std::vector<std::string> texts() const {
    return list(0, [](const Field& entry) { return entry.text(); });
  }
  const nlohmann::ordered_json& json() const { return value_; }
  const std::string& place() const { return place_; }
  std::string text() const {
    require(value_.is_string(), "a text");
    const std::string text = value_.get<std::string>();
    const bool one_line = std::none_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; });
    require(one_line, "a text of one line");  // the text may become a comment in generated code
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
    std::map<std::string, Value> entries;
    for (const auto& [key, value] : value_.items()) entries[key] = read(Field(value, place_ + "." + key));
    return entries;
  }
  std::map<std::string, std::string> text_dictionary() const {
    return dictionary<std::string>([](const Field& entry) { return entry.text(); });
  }
  // Throws `place: expected EXPECTED, found VALUE`.
  void require(bool condition, const std::string& expected) const {
    if (!condition) fail("expected " + expected + ", found " + excerpt());
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::kInput, place_ + ": " + what);
  }

 private:
  std::string excerpt() const {
    const std::string text = value_.dump();
    return text.size() > 40 ? text.substr(0, 37) + "..." : text;
  }
  const nlohmann::ordered_json& value_;
  std::string place_;
};

}  // namespace remap
