// This file packs values as bytes for another process of the same program. Numbers have the same bytes as in
// memory.
#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace remap {

// PackedValues writes and reads values. A struct needs a function `template <typename Archive> void
// fields(Archive& archive, Struct& value)`, which passes each member to the archive: `archive(value.name)`.
class PackedValues {
 public:
  PackedValues() = default;                                                               // for writing
  explicit PackedValues(std::string bytes) : bytes_(std::move(bytes)), is_read_(true) {}  // for reading

  template <typename... Values>
  void operator()(Values&... values) {
    (one(values), ...);
  }
  std::string take() { return std::move(bytes_); }

 private:
  void raw(void* value, std::size_t size) {
    if (!is_read_) return void(bytes_.append(static_cast<const char*>(value), size));
    if (bytes_.size() - place_ < size)
      size = bytes_.size() - place_;  // the process ended before its answer was complete
    std::memcpy(value, bytes_.data() + place_, size);
    place_ += size;
  }
  std::size_t count(std::size_t own) {
    raw(&own, sizeof own);
    return !is_read_ || own <= bytes_.size() ? own : 0;
  }
  template <typename List>
  void list(List& values) {
    const std::size_t size = count(values.size());
    if (is_read_) values.resize(size);
    for (auto& value : values) one(value);
  }

  void one(std::string& text) {
    text.resize(count(text.size()));
    raw(text.data(), text.size());
  }
  void one(std::filesystem::path& path) {
    std::string text = path.string();
    one(text);
    path = text;
  }
  template <typename Value>
  void one(std::vector<Value>& values) {
    list(values);
  }
  template <typename Value>
  void one(std::optional<Value>& value) {
    bool has_value = value.has_value();
    one(has_value);
    if (is_read_ && has_value) value.emplace();
    if (has_value) one(*value);
  }
  template <typename First, typename Second>
  void one(std::pair<First, Second>& pair) {
    one(pair.first);
    one(pair.second);
  }
  template <typename Key, typename Value>
  void one(std::map<Key, Value>& values) {
    std::vector<std::pair<Key, Value>> pairs(values.begin(), values.end());
    one(pairs);
    if (is_read_) values = {pairs.begin(), pairs.end()};
  }
  template <typename Value>
  void one(Value& value) {
    if constexpr (std::is_trivially_copyable_v<Value>)
      raw(&value, sizeof value);
    else
      fields(*this, value);
  }

  std::string bytes_;
  std::size_t place_ = 0;
  bool is_read_ = false;
};

template <typename Value>
std::string packed(Value value) {
  PackedValues values;
  values(value);
  return values.take();
}

template <typename Value>
Value unpacked(std::string bytes) {
  PackedValues values(std::move(bytes));
  Value value{};
  values(value);
  return value;
}

}  // namespace remap
