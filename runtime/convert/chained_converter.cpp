#include "convert/chained_converter.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "remap/error.hpp"

namespace remap {
namespace {

// Texels converted by all steps before the next: two copies of a block, 8 KB each with three channels, and
// its source and target rows fit the first-level cache.
constexpr std::size_t kBlock = 512;
constexpr std::size_t kMostChannels = 3;

using Row = std::array<float, kBlock>;

// A block between two steps.
struct Between {
  Row roughness;
  std::array<Row, kMostChannels> specular;
};

struct ReadRows {
  const float* roughness = nullptr;
  std::array<const float*, kMostChannels> specular{};
};
struct WrittenRows {
  float* roughness = nullptr;
  std::array<float*, kMostChannels> specular{};
};

WrittenRows written(Between& between) {
  return {between.roughness.data(),
          {between.specular[0].data(), between.specular[1].data(), between.specular[2].data()}};
}

ReadRows read(const WrittenRows& rows) {
  return {rows.roughness, {rows.specular[0], rows.specular[1], rows.specular[2]}};
}

// The texels of a block that lay outside the domain of a step.
class OutsideTexels {
 public:
  void add(const ConverterInfo& step, std::size_t count, const ReadRows& given, std::size_t channels) {
    if (!any_) outside_.fill(0);
    any_ = true;
    add_row(step.roughness, count, given.roughness);
    for (std::size_t c = 0; c < channels; ++c) add_row(step.specular, count, given.specular[c]);
  }
  bool any() const noexcept { return any_; }
  std::size_t count() const {
    std::size_t texels = 0;
    if (any_)
      for (const std::uint32_t outside : outside_) texels += outside >> 31;
    return texels;
  }

 private:
  // Floats that are not negative, as the ends of ranges, compare as integers do, which vectorises; a negative
  // float has the sign bit already, and a NaN is above every end.
  void add_row(const Range& range, std::size_t count, const float* values) {
    const auto low = std::bit_cast<std::uint32_t>(static_cast<float>(range.min));
    const auto high = std::bit_cast<std::uint32_t>(static_cast<float>(range.max));
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = std::bit_cast<std::uint32_t>(values[i] + 0.0f);  // -0 becomes 0
      outside_[i] |= value | (value - low) | (high - value);
    }
  }

  bool any_ = false;
  std::array<std::uint32_t, kBlock> outside_;  // the sign bit
};

void require_joined(const std::vector<const Converter*>& steps) {
  const auto side_text = [](const ModelSide& side) {
    return std::string(convention_name(side.roughness)) + " and " + side.specular + " of " + side.model;
  };
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const ConverterInfo &before = steps[i]->info(), &after = steps[i + 1]->info();
    if (before.target == after.source) continue;
    throw Error(ErrorKind::kInput, before.id + " then " + after.id + ": the first gives " +
                                       side_text(before.target) + "; the second expected " +
                                       side_text(after.source));
  }
}

// Unknown as soon as one is.
void add(const std::optional<double>& error, std::optional<double>* sum) {
  if (*sum && error)
    **sum += *error;
  else
    sum->reset();
}

ConverterInfo chained_info(const std::vector<const Converter*>& steps) {
  require_joined(steps);
  ConverterInfo info = steps.front()->info();
  info.target = steps.back()->info().target;
  info.id = converter_id(info.source.model, info.target.model);
  const SourceDomain domain = chained_domain(steps);
  info.roughness = domain.roughness;
  info.specular = domain.specular;
  info.roughness_rms_error = info.specular_rms_error = 0.0;
  info.image_rms_error = 0.0;
  for (const Converter* step : steps) {
    const ConverterInfo& other = step->info();
    add(other.roughness_rms_error, &info.roughness_rms_error);
    add(other.specular_rms_error, &info.specular_rms_error);
    add(other.image_rms_error, &info.image_rms_error);
    info.instructions = std::min(info.instructions, other.instructions);
    info.steps.push_back(other.id);
  }
  return info;
}

class ChainedConverter final : public Converter {
 public:
  explicit ChainedConverter(std::vector<const Converter*> steps)
      : Converter(chained_info(steps)), steps_(std::move(steps)) {}

  std::size_t convert(std::size_t count, const float* roughness, std::span<const float* const> specular,
                      float* roughness_out, std::span<float* const> specular_out) const override {
    if (specular.empty() || specular.size() > kMostChannels)
      throw Error(ErrorKind::kUsage, "converter: got " + std::to_string(specular.size()) +
                                         " specular channels; expected 1 to 3");
    std::size_t outside_count = 0;
    for (std::size_t start = 0; start < count; start += kBlock) {
      ReadRows from{roughness + start, {}};
      WrittenRows to{roughness_out + start, {}};
      for (std::size_t c = 0; c < specular.size(); ++c) {
        from.specular[c] = specular[c] + start;
        to.specular[c] = specular_out[c] + start;
      }
      outside_count += convert_block(std::min(kBlock, count - start), specular.size(), from, to);
    }
    return outside_count;
  }

  bool self_test() const override {
    return std::all_of(steps_.begin(), steps_.end(), [](const Converter* step) { return step->self_test(); });
  }

 private:
  // Steps write to two copies by turns, so that what a step was given is still there after it: the texels of
  // it that are out of domain are looked for only where the step counts some, and has others to be told from.
  std::size_t convert_block(std::size_t count, std::size_t channels, const ReadRows& given,
                            const WrittenRows& result) const {
    std::array<Between, 2> between;
    OutsideTexels outside;
    ReadRows from = given;
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const bool last = k + 1 == steps_.size();
      const WrittenRows to = last ? result : written(between[k % 2]);
      const std::size_t outside_count =
          steps_[k]->convert(count, from.roughness, {from.specular.data(), channels}, to.roughness,
                             {to.specular.data(), channels});
      if (outside_count > 0) {
        if (last && !outside.any()) return outside_count;
        outside.add(steps_[k]->info(), count, from, channels);
      }
      from = read(to);
    }
    return outside.count();
  }

  std::vector<const Converter*> steps_;
};

}  // namespace

std::unique_ptr<Converter> make_chained_converter(std::vector<const Converter*> steps) {
  return std::make_unique<ChainedConverter>(std::move(steps));
}

}  // namespace remap
