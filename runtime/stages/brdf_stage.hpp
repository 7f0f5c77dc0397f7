// This file makes converters of width and specular from the data of lowered fits.
#pragma once

#include <memory>

#include "converter/converter_data.hpp"
#include "remap/converter.hpp"

namespace remap {

// Makes a converter from `data`. Throws kNumeric if the domain is empty or negative.
std::unique_ptr<Converter> make_converter(const ConverterData& data,
                                          InstructionSet set = best_instruction_set());

}  // namespace remap
