// This file makes converters from a fit: by the interpreter, in double precision, and by lowering it.
#pragma once

#include <array>
#include <memory>
#include <utility>

#include "lower/interpreter.hpp"
#include "lower/lower.hpp"
#include "stages/stage.hpp"

namespace remap {

class InterpretedStage final : public Stage {
 public:
  explicit InterpretedStage(Fit fit) : fit_(std::move(fit)) {}

  bool has_domain() const noexcept override { return true; }

  std::size_t run(Block& block, std::uint8_t* outside) const override {
    const std::size_t channels = block.is_grey(Parameter::kSpecular) ? 1 : 3;
    const float* const width = block.row(Parameter::kRoughness);
    const auto specular = block.color(Parameter::kSpecular);
    float* const width_out = block.make(Parameter::kRoughness);
    const auto specular_out = block.make_color(Parameter::kSpecular, channels);
    std::array<double, 3> texel{}, mapped{};
    std::size_t outside_count = 0;
    for (std::size_t i = 0; i < block.size(); ++i) {
      for (std::size_t c = 0; c < channels; ++c) texel[c] = static_cast<double>(specular[c][i]);
      bool in_domain = true;
      width_out[i] =
          static_cast<float>(evaluate_texel(fit_, static_cast<double>(width[i]), {texel.data(), channels},
                                            {mapped.data(), channels}, &in_domain));
      for (std::size_t c = 0; c < channels; ++c) specular_out[c][i] = static_cast<float>(mapped[c]);
      outside_count += !in_domain;
      if (outside != nullptr) outside[i] = !in_domain;
    }
    return outside_count;
  }

 private:
  Fit fit_;
};

inline std::unique_ptr<Converter> make_interpreted_converter(Fit fit) {
  ConverterInfo info;
  info.id = fit.id;
  info.source = fit.source;
  info.target = fit.target;
  info.roughness = own_roughness_range(fit);
  info.specular = specular_range(fit);
  return std::make_unique<Converter>(std::move(info),
                                     StageList{std::make_shared<InterpretedStage>(std::move(fit))});
}

// Returns roughness, red, green and blue of one converted texel; `outside`, if given, is how many were
// outside (0 or 1).
inline std::array<float, 4> converted_texel(const Converter& converter, float roughness,
                                            std::array<float, 3> specular, std::size_t* outside = nullptr) {
  std::array<float, 4> result{};
  const std::array<const float*, 3> in = {&specular[0], &specular[1], &specular[2]};
  const std::array<float*, 3> out = {&result[1], &result[2], &result[3]};
  const std::size_t count = converter.convert(1, &roughness, in, &result[0], out);
  if (outside != nullptr) *outside = count;
  return result;
}

// Returns the fit with its converter.
inline Fit lowered_fit(Fit fit) {
  add_converter(&fit);
  return fit;
}

inline std::unique_ptr<Converter> make_lowered_converter(const Fit& fit,
                                                         InstructionSet set = best_instruction_set()) {
  return make_converter(fit.converter ? *fit.converter : *lowered_fit(fit).converter, set);
}

}  // namespace remap
