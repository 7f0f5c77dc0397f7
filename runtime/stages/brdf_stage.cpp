#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "converter/compact_form.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "stages/kernels.hpp"
#include "stages/stage.hpp"

namespace remap {
namespace {

void require_evaluable(const ConverterData& data) {
  const auto refuse = [&](const std::string& what) { throw numeric_error(data.info.id + ": " + what); };
  for (const FactorTerms* factor : {&data.form.alpha, &data.form.specular}) {
    if (factor->size() > kMostPowersOfT)
      refuse("has " + std::to_string(factor->size()) + " powers of specular (at most " +
             std::to_string(kMostPowersOfT) + " are supported)");
    for (const std::vector<float>& row : *factor)
      if (row.size() > kMostPowersOfAlpha)
        refuse("has " + std::to_string(row.size()) + " powers of alpha (at most " +
               std::to_string(kMostPowersOfAlpha) + " are supported)");
  }
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

// Fills the terms with zeros to rows of the same length. Returns this length.
std::size_t pad(const FactorTerms& factor, FormPass::Terms& rows) {
  std::size_t longest = 0;
  for (std::size_t j = 0; j < factor.size(); ++j) {
    std::ranges::copy(factor[j], rows[j].begin());
    longest = std::max(longest, factor[j].size());
  }
  return longest;
}

FormPass pass_of(const ConverterData& data) {
  const CompactForm& form = data.form;
  const FormEnds ends = ends_of(data.info.source.roughness, data.info.target.roughness, data.info.roughness);
  FormPass pass;
  pass.source = data.info.source.roughness;
  pass.target = data.info.target.roughness;
  pass.width_min = ends.width_min;
  pass.width_max = ends.width_max;
  pass.width_from = ends.width_from;
  pass.width_to = ends.width_to;
  pass.alpha_min = ends.alpha_min;
  pass.least_alpha = ends.least_alpha;
  pass.specular_min = static_cast<float>(data.info.specular.min);
  pass.specular_max = static_cast<float>(data.info.specular.max);
  pass.pole = form.pole;
  constexpr float kNone = std::numeric_limits<float>::infinity();
  pass.alpha_limit = form.alpha_limit.value_or(kNone);
  pass.specular_limit = form.specular_limit.value_or(kNone);
  pass.turn = form.hinge.turn;
  pass.turn_by_alpha = form.hinge.turn_by_alpha;
  pass.bend = form.hinge.bend;
  pass.spread = form.hinge.spread;
  pass.powers = std::max(form.alpha.size(), form.specular.size());
  pass.terms = std::max(pad(form.alpha, pass.alpha_terms), pad(form.specular, pass.specular_terms));
  return pass;
}

bool is_close(float value, float expected, float within) { return std::fabs(value - expected) <= within; }

class BrdfStage final : public Stage {
 public:
  BrdfStage(const ConverterData& data, InstructionSet set)
      : pass_(pass_of(data)), golden_(data.golden), kernel_(kernels(set).convert) {}

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

  // Compares the kernels with the baseline, on grey and RGB rows that are longer than a block and reach
  // beyond the domain.
  bool agrees_with_baseline() const {
    constexpr std::size_t kCount = 301;
    using Row = std::array<float, kCount>;
    Row roughness, specular;
    for (std::size_t i = 0; i < kCount; ++i) {
      const float share = static_cast<float>(i) / (kCount - 1), other = static_cast<float>(i % 17) / 16.0f;
      roughness[i] = pass_.width_min + (1.2f * share - 0.1f) * (pass_.width_max - pass_.width_min);
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

  FormPass pass_;
  std::vector<GoldenTexel> golden_;
  decltype(Kernels::convert) kernel_;
};

}  // namespace

std::unique_ptr<Converter> make_converter(const ConverterData& data, InstructionSet set) {
  require_evaluable(data);
  return std::make_unique<Converter>(info_of(data, set), StageList{std::make_shared<BrdfStage>(data, set)});
}

}  // namespace remap
