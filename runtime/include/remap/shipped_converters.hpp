// The shipped converters: those of generated/converters.json, which is part of the library.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

using ConverterList = std::vector<std::unique_ptr<Converter>>;

// Every shipped converter, in the order of their ids, for an instruction set that this processor has.
const ConverterList& shipped_converters(InstructionSet set = best_instruction_set());

// The converters of a file that `remapc emit --all` wrote, of a fit, or of a folder of fits, in the order of
// their ids. Throws kInput where there is none.
ConverterList read_converters(const std::filesystem::path& path, InstructionSet set = best_instruction_set());

// The shipped converter that leads from one model to another in one step; for longer ways see path.hpp.
// Throws kUsage if there is none.
const Converter& find_converter(const std::string& source_model, const std::string& target_model,
                                InstructionSet set = best_instruction_set());

}  // namespace remap
