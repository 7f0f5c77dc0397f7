// This file returns the shipped converters of generated/converters.json, which is part of the library.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

using ConverterList = std::vector<std::unique_ptr<Converter>>;

// Returns every shipped converter, in the order of their ids, for an instruction set that this processor has.
const ConverterList& shipped_converters(InstructionSet set = best_instruction_set());

// Reads the converters of a file that `remapc emit --all` wrote, of a fit, or of a folder of fits, in the
// order of their ids. Throws kInput if there is none.
ConverterList read_converters(const std::filesystem::path& path, InstructionSet set = best_instruction_set());

// Returns the shipped converter that leads from one model to another in one step. For longer paths, see
// path.hpp. Throws kUsage if there is none.
const Converter& find_converter(const std::string& source_model, const std::string& target_model,
                                InstructionSet set = best_instruction_set());

}  // namespace remap
