// The converters that a program has without being given a fit: those of generated/converters.json, which is
// part of the library, or of a file that a user names instead.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "convert/converter.hpp"
#include "converter_data/converter_data.hpp"

namespace remap {

// Reads converters from `path` instead: a file as `remapc emit --all` writes it, a fit, or a folder of fits.
// Call it before anything else of this header, from one thread. Throws kInput.
void use_converters(const std::filesystem::path& path);

// The data of every shipped converter, in the order of their ids.
const std::vector<ConverterData>& shipped_data();

// Every shipped converter, in the order of their ids, for an instruction set that this processor has.
const std::vector<std::unique_ptr<Converter>>& shipped_converters(
    InstructionSet set = best_instruction_set());

// The shipped converter that leads from one model to another in one step; paths: path.hpp. Throws kUsage
// where there is none.
const Converter& find_converter(const std::string& source_model, const std::string& target_model,
                                InstructionSet set = best_instruction_set());

}  // namespace remap
