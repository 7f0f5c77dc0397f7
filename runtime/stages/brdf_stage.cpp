#include "stages/brdf_stage.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "core/number_text.hpp"
#include "remap/error.hpp"
#include "stages/kernels.hpp"
#include "stages/stage.hpp"

namespace remap {
namespace {

void require_evaluable(const ConverterData& data) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::kNumeric, data.info.id + ": " + what);
  };
  std::vector<const PiecewisePolynomial*> polynomials = {&data.lowered.alpha.polynomial,
                                                         &data.lowered.specular.polynomial};
  if (data.lowered.wide) polynomials.push_back(&data.lowered.wide->specular.function.polynomial);
  if (data.lowered.bright) polynomials.push_back(&data.lowered.bright->function.polynomial);
  for (const PiecewisePolynomial* polynomial : polynomials)
    if (polynomial->degrees.size() > kMostPowers)
      refuse("the degree in specular is " + std::to_string(polynomial->degrees.size() - 1) + " (at most " +
             std::to_string(kMostPowers - 1) + " is supported)");
  for (const PiecewisePolynomial* polynomial : polynomials)
    for (const int degree : polynomial->degrees)
      if (degree > kHighestDegree)
        refuse("a degree in alpha is " + std::to_string(degree) + " (at most " +
               std::to_string(kHighestDegree) + " is supported)");
  if (!(data.info.specular.min >= 0.0 && data.info.specular.max > 0.0 && data.info.roughness.min >= 0.0))
    refuse("the domain is empty or negative (specular must reach above 0, roughness must not be negative)");
}

Range decimal(const Range& range) {
  return {decimal_value(static_cast<float>(range.min)), decimal_value(static_cast<float>(range.max))};
}

ConverterInfo info_of(const ConverterData& data, InstructionSet set) {
  ConverterInfo info = data.info;
  info.roughness = decimal(info.roughness);
  info.specular = decimal(info.specular);
  info.instructions = set;
  return info;
}

LoweredForm form_of(const Lowered& lowered) {
  if (lowered.has_limits()) return LoweredForm::kRegimes;
  const std::vector<int>& degrees = lowered.specular.polynomial.degrees;
  const bool is_factor = degrees.size() == 2 && degrees[0] < 0;
  return is_factor && lowered.alpha.polynomial.degrees.size() == 1 ? LoweredForm::kProportional
                                                                   : LoweredForm::kTerms;
}

// Where the rows of `owned` begin a regime.
RegimePolynomials rows_of(const LoweredSeries& series, std::optional<OwnedPolynomialRows>* owned) {
  return {series.alpha_from, series.specular_from, owned->emplace(series.function.polynomial).rows()};
}

bool is_close(float value, float expected, float within) { return std::fabs(value - expected) <= within; }

class BrdfStage final : public Stage {
 public:
  BrdfStage(const ConverterData& data, InstructionSet set)
      : alpha_(data.lowered.alpha.polynomial),
        specular_(data.lowered.specular.polynomial),
        golden_(data.golden),
        kernel_(kernels(set).convert) {
    constexpr float kNone = std::numeric_limits<float>::max();  // larger than any number that a mapping gives
    pass_.source = data.info.source.roughness;
    pass_.target = data.info.target.roughness;
    pass_.roughness_min = static_cast<float>(data.info.roughness.min);
    pass_.roughness_max = static_cast<float>(data.info.roughness.max);
    pass_.specular_min = static_cast<float>(data.info.specular.min);
    pass_.specular_max = static_cast<float>(data.info.specular.max);
    pass_.inverse_specular_max = static_cast<float>(1.0 / data.info.specular.max);
    const Lowered& lowered = data.lowered;
    pass_.form = form_of(lowered);
    pass_.alpha = alpha_.rows();
    pass_.specular = specular_.rows();
    pass_.alpha_limit = lowered.alpha_limit.value_or(kNone);
    pass_.specular_limit = lowered.specular_limit.value_or(kNone);
    pass_.mapping_to = lowered.wide ? lowered.wide->mapping_to : kNone;
    if (lowered.wide) pass_.wide = rows_of(lowered.wide->specular, &wide_);
    if (lowered.bright) pass_.bright = rows_of(*lowered.bright, &bright_);
  }

  bool has_domain() const noexcept override { return true; }

  std::size_t run(Block& block, std::uint8_t* outside) const override {
    const std::size_t channels = block.is_grey(Parameter::kSpecular) ? 1 : 3;
    const float* const width = block.row(Parameter::kRoughness);
    const auto specular = block.color(Parameter::kSpecular);
    return kernel_(pass_, {block.size(), channels, width, specular, block.make(Parameter::kRoughness),
                           block.make_color(Parameter::kSpecular, channels), outside});
  }

  bool self_test() const override { return gives_golden_texels() && agrees_with_baseline(); }

 private:
  bool gives_golden_texels() const {
    for (const GoldenTexel& golden : golden_) {
      float width = 0.0f, mapped = 0.0f;
      kernel_(pass_, {1, 1, &golden.width, {&golden.specular}, &width, {&mapped}, nullptr});
      if (!is_close(width, golden.width_out, golden.width_within) ||
          !is_close(mapped, golden.specular_out, golden.specular_within))
        return false;
    }
    return true;
  }

  // On rows that are longer than a block and reach beyond the domain, grey and RGB.
  bool agrees_with_baseline() const {
    constexpr std::size_t kCount = 301;
    using Row = std::array<float, kCount>;
    Row roughness, specular;
    for (std::size_t i = 0; i < kCount; ++i) {
      const float share = static_cast<float>(i) / (kCount - 1), other = static_cast<float>(i % 17) / 16.0f;
      roughness[i] =
          pass_.roughness_min + (1.2f * share - 0.1f) * (pass_.roughness_max - pass_.roughness_min);
      specular[i] = pass_.specular_max * 1.2f * other;
    }
    const auto run = [&](const auto& kernel, std::size_t channels) {
      std::array<Row, 4> results{};
      const float* in = specular.data();
      kernel(pass_, {kCount,
                     channels,
                     roughness.data(),
                     {in, in, in},
                     results[0].data(),
                     {results[1].data(), results[2].data(), results[3].data()},
                     nullptr});
      return results;
    };
    for (const std::size_t channels : {1u, 3u}) {
      const auto found = run(kernel_, channels),
                 expected = run(kernels(InstructionSet::kBaseline).convert, channels);
      if (std::memcmp(&found, &expected, sizeof found) != 0) return false;
    }
    return true;
  }

  OwnedPolynomialRows alpha_, specular_;
  std::optional<OwnedPolynomialRows> wide_, bright_;
  std::vector<GoldenTexel> golden_;
  LoweredPass pass_;  // points into the polynomials
  decltype(Kernels::convert) kernel_;
};

}  // namespace

std::unique_ptr<Converter> make_converter(const ConverterData& data, InstructionSet set) {
  require_evaluable(data);
  return std::make_unique<Converter>(info_of(data, set), StageList{std::make_shared<BrdfStage>(data, set)});
}

}  // namespace remap
