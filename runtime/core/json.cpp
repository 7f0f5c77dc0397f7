#include "core/json.hpp"

#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/base64.hpp"

namespace remap {
namespace {

using Library = nlohmann::ordered_json;

bool is_field(const Json& entry) {
  const Json::List* pair = entry.entries();
  return pair != nullptr && pair->size() == 2 && pair->front().text() != nullptr;
}

}  // namespace

Json::Json(std::initializer_list<Json> entries) {
  if (!std::ranges::all_of(entries, is_field) || entries.size() == 0) {
    value_ = List(entries);
    return;
  }
  *this = object();
  for (const Json& entry : entries) (*this)[*entry.entries()->front().text()] = entry.entries()->back();
}

Json Json::list(std::initializer_list<Json> entries) {
  Json json;
  json.value_ = List(entries);
  return json;
}

Json Json::object() {
  Json json;
  json.value_ = Object();
  return json;
}

Json& Json::operator[](const std::string& key) {
  if (is_null()) value_ = Object();
  Object& fields = std::get<Object>(value_);
  const auto found = std::ranges::find_if(fields, [&](const auto& field) { return field.first == key; });
  if (found != fields.end()) return found->second;
  return fields.emplace_back(key, Json()).second;
}

const Json* Json::find(std::string_view key) const {
  const Object* all = fields();
  if (all == nullptr) return nullptr;
  const auto found = std::ranges::find_if(*all, [&](const auto& field) { return field.first == key; });
  return found == all->end() ? nullptr : &found->second;
}

void Json::erase(std::string_view key) {
  std::erase_if(std::get<Object>(value_), [&](const auto& field) { return field.first == key; });
}

void Json::push_back(Json entry) {
  if (is_null()) value_ = List();
  std::get<List>(value_).push_back(std::move(entry));
}

void Json::update(const Json& other) {
  for (const auto& [key, value] : *other.fields()) (*this)[key] = value;
}

std::optional<double> Json::number() const {
  if (const auto* value = std::get_if<double>(&value_)) return *value;
  if (const auto* value = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*value);
  if (const auto* value = std::get_if<std::uint64_t>(&value_)) return static_cast<double>(*value);
  return std::nullopt;
}

std::optional<std::int64_t> Json::whole() const {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  if (const auto* value = std::get_if<std::int64_t>(&value_)) return *value;
  if (const auto* value = std::get_if<std::uint64_t>(&value_); value != nullptr && *value <= kMost)
    return static_cast<std::int64_t>(*value);
  return std::nullopt;
}

std::size_t Json::size() const {
  if (const List* all = entries()) return all->size();
  if (const Object* all = fields()) return all->size();
  return 0;
}

namespace {

Library library_value(const Json& json);

// If a text, or one text in a list, is not UTF-8, returns the bytes. Otherwise, returns null.
Json lost_bytes(const Json& value) {
  if (const std::string* text = value.text()) return is_utf8(*text) ? Json() : Json(base64(*text));
  const Json::List* entries = value.entries();
  const auto is_lost = [](const Json& entry) { return entry.text() != nullptr && !is_utf8(*entry.text()); };
  if (entries == nullptr || std::ranges::none_of(*entries, is_lost)) return {};
  Json all = Json::list();
  for (const Json& entry : *entries)
    all.push_back(entry.text() != nullptr ? Json(base64(*entry.text())) : Json());
  return all;
}

Library library_value_of(std::monostate) { return nullptr; }
Library library_value_of(const Json::List& entries) {
  Library list = Library::array();
  for (const Json& entry : entries) list.push_back(library_value(entry));
  return list;
}
Library library_value_of(const Json::Object& fields) {
  Library object = Library::object();
  // Append the field, because operator[] would search all fields first.
  auto& added = object.get_ref<Library::object_t&>();
  for (const auto& [key, value] : fields) {
    added.emplace_back(key, library_value(value));
    if (const Json bytes = lost_bytes(value); !bytes.is_null())
      added.emplace_back(key + "_base64", library_value(bytes));
  }
  return object;
}
template <typename Scalar>
Library library_value_of(const Scalar& value) {
  return value;
}

Library library_value(const Json& json) {
  return std::visit([](const auto& value) { return library_value_of(value); }, json.value());
}

}  // namespace

std::string Json::dump(int indent) const {
  return library_value(*this).dump(indent, ' ', false, Library::error_handler_t::replace);
}

bool is_utf8(const std::string& text) {
  try {
    (void)Library(text).dump();
    return true;
  } catch (const Library::exception&) {
    return false;
  }
}

}  // namespace remap
