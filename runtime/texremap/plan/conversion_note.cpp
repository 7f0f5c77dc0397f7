#include "texremap/plan/conversion_note.hpp"

#include <array>
#include <cmath>

#include "remap/version.hpp"
#include "texture/content_hash.hpp"

namespace remap {
namespace {

// The hash of a converter covers its results for this many texels. If a number of the converter changes, the
// hash misses this only if no result for these texels changes.
constexpr std::size_t kProbed = 4096;

// Returns term `index` of the additive recurrence of dimension `row` (Weyl 1916, with roots of primes). The
// terms are evenly spread in [0, 1).
double spread(std::size_t index, std::size_t row) {
  constexpr std::array kPrimes = {2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0};
  const double step = std::sqrt(kPrimes[row % kPrimes.size()]);
  const double value = static_cast<double>(index + 1) * step;
  return value - std::floor(value);
}

// Adds the converter's results for texels all over its domain and slightly beyond. They depend on numbers and
// code.
void add_behaviour(const Converter& converter, ContentHash& hash) {
  const ConverterInfo& info = converter.info();
  std::array<std::vector<float>, 3 * kParameterCount> in, out;
  MaterialRows<const float> sources;
  MaterialRows<float> targets;
  std::size_t row = 0;
  for (const Parameter parameter : converter.sources()) {
    const std::size_t count = is_color(parameter) ? 3 : 1;
    Range range{0.0, 1.0};
    if (parameter == Parameter::kRoughness) range = info.roughness;
    if (parameter == Parameter::kSpecular) range = {0.0, info.specular.max};
    sources[parameter].count = count;
    for (std::size_t c = 0; c < count; ++c, ++row) {
      for (std::size_t i = 0; i < kProbed; ++i)
        in[row].push_back(static_cast<float>(range.min + 1.02 * (range.max - range.min) * spread(i, row)));
      sources[parameter].row[c] = in[row].data();
    }
  }
  row = 0;
  for (const Parameter parameter : converter.targets()) {
    if (is_measure(parameter)) continue;
    targets[parameter].count = converter.target_channels(parameter, 3);
    for (std::size_t c = 0; c < targets[parameter].count; ++c, ++row) {
      out[row].resize(kProbed);
      targets[parameter].row[c] = out[row].data();
    }
  }
  converter.convert(kProbed, sources, targets);
  for (const std::vector<float>& values : out)
    hash.add({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

}  // namespace

ConversionNote conversion_note(const std::string& source, const std::string& target, const std::string& ids,
                               const Converter& converter, const std::string& options) {
  ConversionNote note{source, target, "", {}};
  if (!ids.empty()) note.details.emplace_back("converter", ids);
  note.details.emplace_back("options", options);
  note.details.emplace_back("version", kVersion);
  ContentHash hash;
  hash.add(note.source);
  hash.add(note.target);
  for (const auto& [name, value] : note.details) hash.add(value);
  add_behaviour(converter, hash);
  note.hash = hash.hex();
  return note;
}

}  // namespace remap
