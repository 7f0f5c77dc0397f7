#include "remap/converter.hpp"

#include <algorithm>
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

// Ranges as short decimals.
ConverterInfo info_of(const Fit& fit) {
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
          mean_ssim(fit),
          InstructionSet::kBaseline,
          {}};
}

void require_channels(std::size_t count) {
  if (count != 1 && count != 3)
    throw Error(ErrorKind::kUsage,
                "converter: got " + std::to_string(count) + " specular channels (1 or 3 are supported)");
}

class InterpretedConverter final : public Converter {
 public:
  explicit InterpretedConverter(Fit fit) : Converter(info_of(fit)), fit_(std::move(fit)) {}

  std::size_t convert_rows(std::size_t count, const MaterialRows<const float>& in,
                           const MaterialRows<float>& out, std::uint8_t* outside) const override {
    const auto& specular = in[Parameter::kSpecular].row;
    const auto& specular_out = out[Parameter::kSpecular].row;
    const float* const width = in[Parameter::kWidth].row[0];
    const std::size_t channels = in[Parameter::kSpecular].count;
    std::array<double, 3> texel{}, mapped{};
    std::size_t outside_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < channels; ++c) texel[c] = static_cast<double>(specular[c][i]);
      bool in_domain = true;
      const double width_out = evaluate_texel(fit_, static_cast<double>(width[i]), {texel.data(), channels},
                                              {mapped.data(), channels}, &in_domain);
      out[Parameter::kWidth].row[0][i] = static_cast<float>(width_out);
      for (std::size_t c = 0; c < channels; ++c) specular_out[c][i] = static_cast<float>(mapped[c]);
      outside_count += !in_domain;
      if (outside != nullptr) outside[i] = !in_domain;
    }
    return outside_count;
  }

 private:
  Fit fit_;
};

}  // namespace

bool Converter::has_source(Parameter parameter) const noexcept {
  return std::find(sources_.begin(), sources_.end(), parameter) != sources_.end();
}

bool Converter::has_target(Parameter parameter) const noexcept {
  return std::find(targets_.begin(), targets_.end(), parameter) != targets_.end();
}

std::size_t Converter::target_channels(Parameter parameter, std::size_t specular_channels) const noexcept {
  if (!is_color(parameter)) return 1;
  return is_of_brdf() ? specular_channels : 3;
}

std::size_t Converter::convert(std::size_t count, const MaterialRows<const float>& in,
                               const MaterialRows<float>& out, std::uint8_t* outside) const {
  if (has_source(Parameter::kSpecular)) require_channels(in[Parameter::kSpecular].count);
  return convert_rows(count, in, out, outside);
}

std::size_t Converter::convert(std::size_t count, const float* width, std::span<const float* const> specular,
                               float* width_out, std::span<float* const> specular_out,
                               std::uint8_t* outside) const {
  require_channels(specular.size());  // before they are copied
  MaterialRows<const float> in;
  MaterialRows<float> out;
  in[Parameter::kWidth] = {{width}, 1};
  out[Parameter::kWidth] = {{width_out}, 1};
  in[Parameter::kSpecular].count = out[Parameter::kSpecular].count = specular.size();
  std::copy(specular.begin(), specular.end(), in[Parameter::kSpecular].row.begin());
  std::copy(specular_out.begin(), specular_out.end(), out[Parameter::kSpecular].row.begin());
  return convert_rows(count, in, out, outside);
}

std::unique_ptr<Converter> make_interpreted_converter(Fit fit) {
  return std::make_unique<InterpretedConverter>(std::move(fit));
}

}  // namespace remap
