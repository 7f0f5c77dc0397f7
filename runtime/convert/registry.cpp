// The converters that were compiled into this program: the generated registry behind the interface.
#include "registry.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "convert/compiled_kernels.hpp"
#include "convert/converter.hpp"
#include "remap/error.hpp"
#include "text/number_text.hpp"

namespace remap {
namespace {

ModelSide side(const char* model, const char* roughness, const char* specular) {
  return {model, convention_from_name(roughness).value(), specular};
}

ConverterInfo info_of(const ConverterEntry& entry, InstructionSet set) {
  const auto known = [](float error) {
    return error >= 0.0f ? std::optional<double>(decimal_value(error)) : std::nullopt;
  };
  return {entry.id,
          side(entry.source_model, entry.source_roughness, entry.source_specular),
          side(entry.target_model, entry.target_roughness, entry.target_specular),
          {decimal_value(entry.roughness_min), decimal_value(entry.roughness_max)},
          {decimal_value(entry.specular_min), decimal_value(entry.specular_max)},
          known(entry.roughness_rms_error),
          known(entry.specular_rms_error),
          known(entry.image_rms_error),
          set,
          {}};
}

// Whether the kernel gives the bits of the header as it was compiled for everybody, on rows that are longer
// than any vector and reach beyond the domain.
bool agrees_with_baseline(const ConverterEntry& entry, const CompiledKernels& kernels) {
  constexpr std::size_t kCount = 301;
  using Row = std::array<float, kCount>;
  Row roughness, specular;
  for (std::size_t i = 0; i < kCount; ++i) {
    const float share = static_cast<float>(i) / (kCount - 1), other = static_cast<float>(i % 17) / 16.0f;
    roughness[i] = entry.roughness_min + (1.2f * share - 0.1f) * (entry.roughness_max - entry.roughness_min);
    specular[i] = entry.specular_max * 1.2f * other;
  }
  const auto same = [](const Row& a, const Row& b) { return std::memcmp(&a, &b, sizeof a) == 0; };
  Row width, mapped, expected_width, expected;
  std::array<Row, 3> channels;
  entry.evaluate_1(kCount, roughness.data(), {specular.data()}, expected_width.data(), {expected.data()});
  kernels.grey(kCount, roughness.data(), {specular.data()}, width.data(), {mapped.data()});
  if (!same(width, expected_width) || !same(mapped, expected)) return false;
  const float* in = specular.data();
  kernels.rgb(kCount, roughness.data(), {in, in, in}, width.data(),
              {channels[0].data(), channels[1].data(), channels[2].data()});
  return same(width, expected_width) && same(channels[0], expected) && same(channels[1], expected) &&
         same(channels[2], expected);
}

class CompiledConverter final : public Converter {
 public:
  CompiledConverter(const ConverterEntry& entry, const CompiledKernels& kernels, InstructionSet set)
      : Converter(info_of(entry, set)), entry_(entry), kernels_(kernels) {}

  std::size_t convert(std::size_t count, const float* roughness, std::span<const float* const> specular,
                      float* roughness_out, std::span<float* const> specular_out) const override {
    if (specular.size() == 1)
      return kernels_.grey(count, roughness, {specular[0]}, roughness_out, {specular_out[0]});
    if (specular.size() == 3)
      return kernels_.rgb(count, roughness, {specular[0], specular[1], specular[2]}, roughness_out,
                          {specular_out[0], specular_out[1], specular_out[2]});
    throw Error(ErrorKind::kUsage,
                "converter: got " + std::to_string(specular.size()) + " specular channels; expected 1 or 3");
  }

  bool self_test() const override { return entry_.self_test() && agrees_with_baseline(entry_, kernels_); }

 private:
  const ConverterEntry& entry_;
  CompiledKernels kernels_;
};

using ConverterVector = std::vector<std::unique_ptr<Converter>>;

ConverterVector make_converters(InstructionSet set) {
  const std::vector<CompiledKernels> kernels = compiled_kernels(set);
  ConverterVector made;
  for (std::size_t i = 0; i < kConverters.size(); ++i)
    made.push_back(std::make_unique<CompiledConverter>(kConverters[i], kernels[i], set));
  std::sort(made.begin(), made.end(),
            [](const auto& a, const auto& b) { return a->info().id < b->info().id; });
  return made;
}

}  // namespace

const ConverterVector& compiled_converters(InstructionSet set) {
  static const std::array<ConverterVector, 3> converters = {make_converters(InstructionSet::kBaseline),
                                                            make_converters(InstructionSet::kAvx2),
                                                            make_converters(InstructionSet::kAvx512)};
  return converters[static_cast<std::size_t>(set)];
}

const Converter& find_converter(const std::string& source_model, const std::string& target_model,
                                InstructionSet set) {
  for (const auto& converter : compiled_converters(set)) {
    const ConverterInfo& info = converter->info();
    if (info.source.model == source_model && info.target.model == target_model) return *converter;
  }
  throw Error(ErrorKind::kUsage, source_model + " to " + target_model +
                                     ": there is no converter; expected models that one converter joins");
}

}  // namespace remap
