// Converters of width and specular by the data of lowered fits.
#pragma once

#include <memory>

#include "converter/converter_data.hpp"
#include "remap/converter.hpp"

namespace remap {

// Runs `data` as it is. Throws kNumeric for a domain that is empty or negative.
std::unique_ptr<Converter> make_converter(const ConverterData& data,
                                          InstructionSet set = best_instruction_set());

}  // namespace remap
