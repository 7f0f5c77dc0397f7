// This program prints a hash of the result of each conversion of the library, over 65,536 texels, on every
// instruction set of the processor, one line per case. Every compiler and every machine must print the lines
// in bits.txt.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "remap/convert_maps.hpp"
#include "remap/error.hpp"
#include "remap/shipped_converters.hpp"
#include "remap/workflow.hpp"

using namespace remap;

namespace {

constexpr std::size_t kTexels = 65536;
constexpr std::size_t kMostRows = 9;
using FloatRow = std::vector<float>;

// RandomNumbers is SplitMix64 (G. Steele, D. Lea, C. Flood, 2014).
class RandomNumbers {
 public:
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }

 private:
  std::uint64_t state_ = 44;
};

// Returns a value between 0 and 1 in most cases. One in eight is an arbitrary float, and one in eight is a
// special value.
float random_value(RandomNumbers& random) {
  constexpr std::array kSpecial = {0.0f,
                                   -0.0f,
                                   1.0f,
                                   -1.0f,
                                   0.04f,
                                   1e-40f,
                                   -1e-40f,
                                   std::numeric_limits<float>::infinity(),
                                   -std::numeric_limits<float>::infinity(),
                                   std::numeric_limits<float>::quiet_NaN(),
                                   std::numeric_limits<float>::max(),
                                   std::numeric_limits<float>::min(),
                                   0.0031308f,
                                   0.04045f,
                                   0.5f,
                                   1.0000001f};
  const std::uint64_t bits = random.next();
  const auto high = static_cast<std::uint32_t>(bits >> 32);
  switch (bits % 8) {
    case 0:
      return __builtin_bit_cast(float, high);
    case 1:
      return kSpecial[high % kSpecial.size()];
    default:
      return static_cast<float>(high >> 8) * 0x1p-24f;
  }
}

std::vector<FloatRow> random_rows() {
  RandomNumbers random;
  std::vector<FloatRow> rows(kMostRows, FloatRow(kTexels));
  for (std::size_t i = 0; i < kTexels; ++i)
    for (FloatRow& row : rows) row[i] = random_value(random);
  return rows;
}

// Hash is FNV-1a of 64 bits (G. Fowler, L. Noll, P. Vo) over integers.
class Hash {
 public:
  void add(std::uint64_t number) { hash_ = (hash_ ^ number) * 0x100000001b3u; }
  // Standards do not fix the sign and payload of NaN, so all NaNs are hashed alike.
  void add(const FloatRow& row) {
    for (const float value : row)
      add(std::isnan(value) ? 0x7fc00000u : __builtin_bit_cast(std::uint32_t, value));
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

void print(const std::string& name, std::uint64_t hash) {
  std::printf("%016llx %s\n", static_cast<unsigned long long>(hash), name.c_str());
}

// Prints one line if the hashes of all instruction sets are equal, otherwise one line per set.
void print_sets(const std::string& name, const std::function<std::uint64_t(InstructionSet)>& hash_of) {
  const std::uint64_t baseline = hash_of(InstructionSet::kBaseline);
  print(name, baseline);
  for (const InstructionSet set : instruction_sets())
    if (const std::uint64_t hash = hash_of(set); hash != baseline)
      print(name + " on " + std::string(instruction_set_name(set)), hash);
}

std::uint64_t hash_of(const Converter& converter, const std::vector<FloatRow>& random) {
  MaterialRows<const float> in;
  MaterialRows<float> out;
  std::size_t used = 0;
  for (const Parameter parameter : converter.sources()) {
    in[parameter].count = is_color(parameter) ? 3 : 1;
    for (std::size_t c = 0; c < in[parameter].count; ++c) in[parameter].row[c] = random[used++].data();
  }
  std::vector<FloatRow> made;
  made.reserve(3 * kParameterCount);
  for (const Parameter parameter : converter.targets()) {
    out[parameter].count = converter.target_channels(parameter, 3);
    for (std::size_t c = 0; c < out[parameter].count; ++c)
      out[parameter].row[c] = made.emplace_back(kTexels).data();
  }
  std::vector<std::uint8_t> outside(kTexels);
  Hash hash;
  hash.add(converter.convert(kTexels, in, out, outside.data()));
  for (const FloatRow& row : made) hash.add(row);
  for (const std::uint8_t flag : outside) hash.add(flag);
  return hash.value();
}

void print_converters(const std::vector<FloatRow>& random) {
  const ConverterList& baseline = shipped_converters(InstructionSet::kBaseline);
  for (std::size_t i = 0; i < baseline.size(); ++i)
    print_sets(baseline[i]->info().id,
               [&](InstructionSet set) { return hash_of(*shipped_converters(set)[i], random); });
}

// Converts between all workflows that have the same BRDF.
void print_workflows(const std::vector<FloatRow>& random) {
  for (const WorkflowModel& source : workflow_models())
    for (const WorkflowModel& target : workflow_models()) {
      if (&source == &target || source.brdf != target.brdf) continue;
      WorkflowStages stages{source.end, target.end};
      stages.width = width_of(target.end);
      print_sets(model_of(source.end) + " to " + model_of(target.end),
                 [&](InstructionSet set) { return hash_of(*make_workflow_converter(stages, set), random); });
    }
}

void print_curves(const FloatRow& random) {
  const auto print_changed = [&](const std::string& name, const std::function<void(FloatRow&)>& change) {
    FloatRow changed = random;
    change(changed);
    Hash hash;
    hash.add(changed);
    print(name, hash.value());
  };
  print_changed("sRGB to linear", [](FloatRow& row) { to_linear(Transfer::kSrgb, row); });
  print_changed("linear to sRGB", [](FloatRow& row) { from_linear(Transfer::kSrgb, row); });
  for (const auto& from : kRoughnessEncodings)
    for (const auto& to : kRoughnessEncodings)
      if (from.value != to.value)
        print_changed(std::string(from.name) + " to " + std::string(to.name),
                      [&](FloatRow& row) { change_convention(from.value, to.value, row); });
}

void print_pixel_types(const FloatRow& random) {
  for (const auto& type : kPixelTypes) {
    const std::size_t size = byte_count(type.value);
    std::vector<std::byte> stored(kTexels * size);
    FloatRow loaded(kTexels);
    FloatRow clean = random;  // floats and half floats keep NaN unchanged
    for (float& value : clean)
      if (std::isnan(value)) value = std::numeric_limits<float>::quiet_NaN();
    Hash hash;
    hash.add(store_values(type.value, clean.data(), kTexels, stored.data(), size));
    for (const std::byte byte : stored) hash.add(std::to_integer<std::uint8_t>(byte));
    load_values(type.value, stored.data(), size, kTexels, loaded.data());
    hash.add(loaded);
    print("pixels of " + std::string(type.name), hash.value());
  }
}

}  // namespace

int main() try {
  const std::vector<FloatRow> random = random_rows();
  print_converters(random);
  print_workflows(random);
  print_curves(random.front());
  print_pixel_types(random.front());
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "bits: %s\n", error.what());
  return 1;
}
