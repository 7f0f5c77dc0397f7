// This file holds JSON values. The programs print and write them, and parse_json() (json_field.hpp) returns
// them. Only json.cpp includes the library that turns values into text.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace remap {

// A Json is a JSON value. A list in braces becomes an object if every entry is a pair that begins with a
// text: `{{"id", id}, {"rows", 3}}`. Json::list() makes a list of such pairs.
class Json {
 public:
  using List = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;  // in the order of insertion

  Json() = default;  // null
  Json(std::nullptr_t) {}
  Json(bool value) : value_(value) {}
  template <std::integral T>
  Json(T value) {
    if constexpr (std::is_signed_v<T>)
      value_ = static_cast<std::int64_t>(value);
    else
      value_ = static_cast<std::uint64_t>(value);
  }
  template <std::floating_point T>
  Json(T value) : value_(static_cast<double>(value)) {}
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  Json(std::string_view text) : value_(std::string(text)) {}
  template <typename T>
  Json(const std::optional<T>& value) {
    if (value) *this = Json(*value);
  }
  template <typename T>
  Json(const std::vector<T>& values) : value_(List(values.begin(), values.end())) {}
  template <typename T, std::size_t N>
  Json(const std::array<T, N>& values) : value_(List(values.begin(), values.end())) {}
  template <typename T>
  Json(const std::map<std::string, T>& values) : value_(Object(values.begin(), values.end())) {}
  Json(List entries) : value_(std::move(entries)) {}
  Json(Object fields) : value_(std::move(fields)) {}
  Json(std::initializer_list<Json> entries);

  static Json list(std::initializer_list<Json> entries = {});
  static Json object();

  // Returns the field of an object, and adds it if it is missing. A null value becomes an object.
  Json& operator[](const std::string& key);
  // Returns the field, or null if this object lacks it or if this is not an object.
  const Json* find(std::string_view key) const;
  bool contains(std::string_view key) const { return find(key) != nullptr; }
  // Removes a field if it exists.
  void erase(std::string_view key);
  // Adds an entry to a list. A null value becomes a list.
  void push_back(Json entry);
  // Adds the fields of another object. A field that exists already gets the new value.
  void update(const Json& other);

  // These functions return null if the value has another type.
  const bool* boolean() const { return std::get_if<bool>(&value_); }
  const std::string* text() const { return std::get_if<std::string>(&value_); }
  const List* entries() const { return std::get_if<List>(&value_); }
  const Object* fields() const { return std::get_if<Object>(&value_); }
  List* entries() { return std::get_if<List>(&value_); }
  // Return nothing if this is not a number (number()), or not a signed 64-bit integer (whole()).
  std::optional<double> number() const;
  std::optional<std::int64_t> whole() const;
  bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  // Returns the number of entries or fields, and 0 for other values.
  std::size_t size() const;
  bool empty() const { return size() == 0; }

  // Returns the text on one line, or with `indent` spaces for each level. A text that is not UTF-8, as a file
  // name may be, gets replacement characters. If a field `path` has such a text, a field `path_base64` next
  // to it holds the bytes. The same applies to lists of texts.
  std::string dump(int indent = -1) const;

  using Value =
      std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, List, Object>;
  const Value& value() const { return value_; }

 private:
  Value value_;
};

// Returns true if JSON can hold a text unchanged.
bool is_utf8(const std::string& text);

}  // namespace remap
