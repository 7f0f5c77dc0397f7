// Converters that are made from a fit: by the interpreter, in double precision, and by lowering it.
#pragma once

#include <array>
#include <memory>
#include <utility>

#include "convert/data_converter.hpp"
#include "lower/lower.hpp"
#include "model/interpreter.hpp"

namespace remap {

class InterpretedConverter final : public Converter {
 public:
  explicit InterpretedConverter(Fit fit) : Converter(info_of(fit)), fit_(std::move(fit)) {}

 private:
  static ConverterInfo info_of(const Fit& fit) {
    ConverterInfo info;
    info.id = fit.id;
    info.source = fit.source;
    info.target = fit.target;
    info.roughness = own_roughness_range(fit);
    info.specular = specular_range(fit);
    return info;
  }

  std::size_t convert_rows(std::size_t count, const MaterialRows<const float>& in,
                           const MaterialRows<float>& out, std::uint8_t* outside) const override {
    const auto& specular = in[Parameter::kSpecular];
    std::array<double, 3> texel{}, mapped{};
    std::size_t outside_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < specular.count; ++c) texel[c] = static_cast<double>(specular.row[c][i]);
      bool in_domain = true;
      out[Parameter::kWidth].row[0][i] = static_cast<float>(
          evaluate_texel(fit_, static_cast<double>(in[Parameter::kWidth].row[0][i]),
                         {texel.data(), specular.count}, {mapped.data(), specular.count}, &in_domain));
      for (std::size_t c = 0; c < specular.count; ++c)
        out[Parameter::kSpecular].row[c][i] = static_cast<float>(mapped[c]);
      outside_count += !in_domain;
      if (outside != nullptr) outside[i] = !in_domain;
    }
    return outside_count;
  }

  Fit fit_;
};

inline std::unique_ptr<Converter> make_interpreted_converter(Fit fit) {
  return std::make_unique<InterpretedConverter>(std::move(fit));
}

// The fit with its converter.
inline Fit lowered_fit(Fit fit, const LoweringOptions& options = {}) {
  add_converter(&fit, options);
  return fit;
}

inline std::unique_ptr<Converter> make_lowered_converter(const Fit& fit,
                                                         InstructionSet set = best_instruction_set()) {
  return make_converter(fit.converter ? *fit.converter : *lowered_fit(fit).converter, set);
}

}  // namespace remap
