#include "assets/gltf/gltf_factors.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr std::size_t kExcerptLength = 40;

}  // namespace

void FactorReader::read(const char* name, FactorText& factor, double most) const {
  if (const SpanValue value = object_[name]) factor = read_number(value, name, most);
}

std::vector<SpanValue> FactorReader::entries_of(const char* name, std::size_t count) const {
  const SpanValue value = object_[name];
  if (!value) return {};
  const std::vector<SpanValue> entries = value.entries();
  if (entries.size() != count)
    throw input_error(std::string(name) + ": expected a list of " + std::to_string(count) +
                      " numbers, found " + plain(value.raw(), kExcerptLength));
  return entries;
}

FactorText FactorReader::read_number(SpanValue value, const std::string& name, double most) const {
  const std::optional<double> number = value.number();
  const std::string found = plain(value.raw(), kExcerptLength);
  const std::string range = most == kNoLimit ? "from 0" : "from 0 to " + number_text(most);
  if (!number) throw input_error(name + ": expected a number " + range + ", found " + found);
  const double clamped = std::clamp(*number, 0.0, most);
  if (clamped == *number) return {clamped, std::string(value.raw())};
  warnings_.push_back(name + " " + found + " is outside of 0 to " +
                      (most == kNoLimit ? "infinity" : number_text(most)) + " and becomes " +
                      number_text(clamped));
  return {clamped, number_text(clamped)};
}

std::string list_text(const std::vector<std::string>& entries) {
  std::string text;
  for (const std::string& entry : entries) text += (text.empty() ? "" : ",") + entry;
  return "[" + text + "]";
}

void multiply(FactorText& factor, float value) {
  if (value == 1.0f) return;
  factor.value *= static_cast<double>(value);
  factor.text = float_text(static_cast<float>(factor.value));
}

MaterialFactor reported(std::string name, const std::vector<float>& values) {
  MaterialFactor factor{std::move(name), {}};
  for (const float value : values) factor.values.push_back(decimal_value(value));
  return factor;
}

}  // namespace remap
