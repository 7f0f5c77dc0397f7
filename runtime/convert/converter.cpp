#include "convert/converter.hpp"

#include <array>
#include <utility>

#include "model/interpreter.hpp"
#include "remap/error.hpp"
#include "text/number_text.hpp"

namespace remap {
namespace {

Range decimal(const Range& range) {
  return {decimal_value(static_cast<float>(range.min)), decimal_value(static_cast<float>(range.max))};
}

class InterpretedConverter final : public Converter {
 public:
  explicit InterpretedConverter(Fit fit)
      : Converter(converter_info(fit, InstructionSet::kBaseline)), fit_(std::move(fit)) {}

  std::size_t convert(std::size_t count, const float* roughness, std::span<const float* const> specular,
                      float* roughness_out, std::span<float* const> specular_out,
                      std::uint8_t* outside) const override {
    std::array<double, 3> in{}, out{};
    const std::size_t channels = specular.size();
    if (channels > in.size())
      throw Error(ErrorKind::kUsage,
                  "converter: got " + std::to_string(channels) + " specular channels (1 to 3 are supported)");
    std::size_t outside_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < channels; ++c) in[c] = static_cast<double>(specular[c][i]);
      bool in_domain = true;
      const double width = evaluate_texel(fit_, static_cast<double>(roughness[i]), {in.data(), channels},
                                          {out.data(), channels}, &in_domain);
      roughness_out[i] = static_cast<float>(width);
      for (std::size_t c = 0; c < channels; ++c) specular_out[c][i] = static_cast<float>(out[c]);
      outside_count += !in_domain;
      if (outside != nullptr) outside[i] = !in_domain;
    }
    return outside_count;
  }

  // It is the definition that golden texels are made from.
  bool self_test() const override { return true; }

 private:
  Fit fit_;
};

}  // namespace

ConverterInfo converter_info(const Fit& fit, InstructionSet instructions) {
  const auto image_error = fit.image_similarity ? std::optional<double>(fit.image_similarity->image_error.rms)
                                                : std::optional<double>();
  const auto known = [&](double error) {
    return fit.has_errors() ? std::optional<double>(error) : std::nullopt;
  };
  return {fit.id,
          fit.source,
          fit.target,
          decimal(own_roughness_range(fit)),
          decimal(specular_range(fit)),
          known(fit.alpha_error.rms),
          known(fit.specular_error.rms),
          image_error,
          instructions,
          {}};
}

std::unique_ptr<Converter> make_interpreted_converter(Fit fit) {
  return std::make_unique<InterpretedConverter>(std::move(fit));
}

}  // namespace remap
