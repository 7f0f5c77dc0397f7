// Names of enumerators in files and on the command line.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

template <typename Value>
struct NamedValue {
  Value value;
  std::string_view name;
};

// Each enumerator appears once.
template <typename Value, std::size_t Count>
using NamedValues = std::array<NamedValue<Value>, Count>;

// Empty for a value that is not in the table.
template <typename Value, std::size_t Count>
constexpr std::string_view name_of(const NamedValues<Value, Count>& table, Value value) noexcept {
  for (const NamedValue<Value>& entry : table)
    if (entry.value == value) return entry.name;
  return {};
}

template <typename Value, std::size_t Count>
constexpr std::optional<Value> value_named(const NamedValues<Value, Count>& table,
                                           std::string_view name) noexcept {
  for (const NamedValue<Value>& entry : table)
    if (entry.name == name) return entry.value;
  return std::nullopt;
}

// All names in the order of the table.
template <typename Value, std::size_t Count>
std::vector<std::string> names_of(const NamedValues<Value, Count>& table) {
  std::vector<std::string> names;
  for (const NamedValue<Value>& entry : table) names.emplace_back(entry.name);
  return names;
}

}  // namespace remap
