// Converters made from lowered fits.
#pragma once

#include <memory>

#include "converter_data/converter_data.hpp"
#include "lower/lowered.hpp"
#include "remap/converter.hpp"

namespace remap {

// Runs `data` as it is. Throws kNumeric for a domain that is empty or negative.
std::unique_ptr<Converter> make_converter(const ConverterData& data,
                                          InstructionSet set = best_instruction_set());

// As make_lowered_converter(fit, set); `lowered` is the result of lower() for the fit.
std::unique_ptr<Converter> make_lowered_converter(const Fit& fit, const Lowered& lowered, InstructionSet set);

}  // namespace remap
