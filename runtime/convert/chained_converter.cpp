#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "remap/error.hpp"
#include "remap/path.hpp"

namespace remap {
namespace {

// Texels converted by all steps before the next: two copies of a block, 8 KB each with three channels, and
// its source and target rows fit the first-level cache.
constexpr std::size_t kBlock = 512;
constexpr std::size_t kMostChannels = 3;

// The rows of width and specular that a step writes for the next.
class Block {
 public:
  MaterialRows<float> rows(std::size_t channels) {
    MaterialRows<float> rows;
    rows[Parameter::kWidth] = {{values_[0].data()}, 1};
    rows[Parameter::kSpecular] = {{values_[1].data(), values_[2].data(), values_[3].data()}, channels};
    return rows;
  }

 private:
  std::array<std::array<float, kBlock>, 1 + kMostChannels> values_;
};

// The rows of width and specular of `rows`, from texel `start` on.
template <typename To, typename From>
MaterialRows<To> from_texel(const MaterialRows<From>& rows, std::size_t start) {
  MaterialRows<To> moved;
  for (const Parameter parameter : {Parameter::kWidth, Parameter::kSpecular}) {
    moved[parameter].count = rows[parameter].count;
    for (std::size_t c = 0; c < rows[parameter].count; ++c)
      moved[parameter].row[c] = rows[parameter].row[c] + start;
  }
  return moved;
}

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
  info.ssim = 1.0;
  for (const Converter* step : steps) {
    const ConverterInfo& other = step->info();
    add(other.roughness_rms_error, &info.roughness_rms_error);
    add(other.specular_rms_error, &info.specular_rms_error);
    add(other.image_rms_error, &info.image_rms_error);
    info.ssim = info.ssim && other.ssim ? std::optional(std::min(*info.ssim, *other.ssim)) : std::nullopt;
    info.instructions = std::min(info.instructions, other.instructions);
    info.steps.push_back(other.id);
  }
  return info;
}

class ChainedConverter final : public Converter {
 public:
  explicit ChainedConverter(std::vector<const Converter*> steps)
      : Converter(chained_info(steps)), steps_(std::move(steps)) {}

  std::size_t convert_rows(std::size_t count, const MaterialRows<const float>& in,
                           const MaterialRows<float>& out, std::uint8_t* outside) const override {
    std::size_t outside_count = 0;
    std::array<std::uint8_t, kBlock> flags;
    for (std::size_t start = 0; start < count; start += kBlock) {
      const std::size_t size = std::min(kBlock, count - start);
      convert_block(size, from_texel<const float>(in, start), from_texel<float>(out, start), flags.data());
      for (std::size_t i = 0; i < size; ++i) outside_count += flags[i];
      if (outside != nullptr) std::copy_n(flags.begin(), size, outside + start);
    }
    return outside_count;
  }

  bool self_test() const override {
    return std::all_of(steps_.begin(), steps_.end(), [](const Converter* step) { return step->self_test(); });
  }

 private:
  // A texel is out of domain where it is for any step: `outside` gets their flags together. Steps write to
  // two copies by turns, as what a step is given must stay while it runs.
  void convert_block(std::size_t count, MaterialRows<const float> in, const MaterialRows<float>& result,
                     std::uint8_t* outside) const {
    std::array<Block, 2> between;
    std::array<std::uint8_t, kBlock> of_step;
    std::fill_n(outside, count, std::uint8_t{0});
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const MaterialRows<float> out =
          k + 1 == steps_.size() ? result : between[k % 2].rows(in[Parameter::kSpecular].count);
      if (steps_[k]->convert(count, in, out, of_step.data()) > 0)
        for (std::size_t i = 0; i < count; ++i)
          outside[i] = static_cast<std::uint8_t>(outside[i] | of_step[i]);
      in = from_texel<const float>(out, 0);
    }
  }

  std::vector<const Converter*> steps_;
};

}  // namespace

std::unique_ptr<Converter> make_chained_converter(std::vector<const Converter*> steps) {
  return std::make_unique<ChainedConverter>(std::move(steps));
}

}  // namespace remap
