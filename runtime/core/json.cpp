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
  if (!std::all_of(entries.begin(), entries.end(), is_field) || entries.size() == 0) {
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
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == key; });
  if (found != fields.end()) return found->second;
  return fields.emplace_back(key, Json()).second;
}

const Json* Json::find(std::string_view key) const {
  const Object* all = fields();
  if (all == nullptr) return nullptr;
  const auto found =
      std::find_if(all->begin(), all->end(), [&](const auto& field) { return field.first == key; });
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

// `at line 2, column 1: unexpected end of input` of `[json.exception.parse_error.101] parse error at line 2,
// column 1: syntax error while parsing value - unexpected end of input`.
std::string place_and_reason(std::string text) {
  constexpr std::string_view kStart = "parse error ", kSyntax = "syntax error while parsing value - ";
  if (const std::size_t at = text.find(kStart); at != std::string::npos) text.erase(0, at + kStart.size());
  if (const std::size_t at = text.find(kSyntax); at != std::string::npos) text.erase(at, kSyntax.size());
  return text;
}

}  // namespace

// What a parser of the library says of a text, as a value.
class JsonBuilder {
 public:
  Json root;
  std::string reason;

  static Library library_value(const Json& json) {
    return std::visit([](const auto& value) { return library_value_of(value); }, json.value_);
  }

  bool null() { return add(Json()); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value); }
  bool number_unsigned(std::uint64_t value) { return add(value); }
  bool number_float(double value, const std::string&) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Library::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::list()); }
  bool key(std::string& name) {
    Open& object = open_.back();
    auto& fields = std::get<Json::Object>(object.value->value_);
    if (fields.size() < kFewFields) {
      place_ = &(*object.value)[name];
      return true;
    }
    if (object.places.empty())
      for (std::size_t i = 0; i < fields.size(); ++i) object.places[fields[i].first] = i;
    const auto [place, is_new] = object.places.try_emplace(name, fields.size());
    if (is_new) fields.emplace_back(name, Json());
    place_ = &fields[place->second].second;
    return true;
  }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& failure) {
    reason = place_and_reason(failure.what());
    return false;
  }

 private:
  // To look through more fields for each key would take time with the square of their number.
  static constexpr std::size_t kFewFields = 16;

  // An object or list that is being read.
  struct Open {
    Json* value;
    std::map<std::string, std::size_t> places;  // of the fields, by name; empty below kFewFields
  };

  static Library library_value_of(std::monostate) { return nullptr; }
  static Library library_value_of(const Json::List& entries) {
    Library list = Library::array();
    for (const Json& entry : entries) list.push_back(library_value(entry));
    return list;
  }
  static Library library_value_of(const Json::Object& fields) {
    Library object = Library::object();
    // Appended, since operator[] would look through all fields before.
    auto& added = object.get_ref<Library::object_t&>();
    for (const auto& [key, value] : fields) {
      added.emplace_back(key, library_value(value));
      if (const Json bytes = lost_bytes(value); !bytes.is_null())
        added.emplace_back(key + "_base64", library_value(bytes));
    }
    return object;
  }
  template <typename Scalar>
  static Library library_value_of(const Scalar& value) {
    return value;
  }

  // The bytes of a text, or of a list's texts, of which one is no UTF-8; else null.
  static Json lost_bytes(const Json& value) {
    if (const std::string* text = value.text()) return is_utf8(*text) ? Json() : Json(base64(*text));
    const Json::List* entries = value.entries();
    const auto is_lost = [](const Json& entry) { return entry.text() != nullptr && !is_utf8(*entry.text()); };
    if (entries == nullptr || std::ranges::none_of(*entries, is_lost)) return {};
    Json all = Json::list();
    for (const Json& entry : *entries)
      all.push_back(entry.text() != nullptr ? Json(base64(*entry.text())) : Json());
    return all;
  }

  // Values of a list move when it grows, but not while one of them is open.
  Json* put(Json value) {
    if (open_.empty()) return &(root = std::move(value));
    if (place_ != nullptr) return &(*std::exchange(place_, nullptr) = std::move(value));
    return &open_.back().value->entries()->emplace_back(std::move(value));
  }
  bool add(Json value) { return put(std::move(value)) != nullptr; }
  bool open(Json value) {
    open_.push_back({put(std::move(value)), {}});
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::vector<Open> open_;  // the outermost first
  Json* place_ = nullptr;   // of the next value, after a key
};

std::string Json::dump(int indent) const {
  return JsonBuilder::library_value(*this).dump(indent, ' ', false, Library::error_handler_t::replace);
}

bool is_utf8(const std::string& text) {
  try {
    (void)Library(text).dump();
    return true;
  } catch (const Library::exception&) {
    return false;
  }
}

std::variant<Json, JsonFault> json_of(std::string_view text) {
  JsonBuilder builder;
  if (!Library::sax_parse(text, &builder)) return JsonFault{builder.reason};
  return std::move(builder.root);
}

}  // namespace remap
