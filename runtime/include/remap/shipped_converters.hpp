// The shipped converters: those of generated/converters.json, which is part of the library, or of a file that
// the user names instead.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

// Replaces the shipped converters by those of `path`: a file that `remapc emit --all` wrote, a fit, or a
// folder of fits; an empty path changes nothing. Call it before any other function of this header, from one
// thread. Throws kInput.
void use_converters(const std::filesystem::path& path);

// Every shipped converter, in the order of their ids, for an instruction set that this processor has.
const std::vector<std::unique_ptr<Converter>>& shipped_converters(
    InstructionSet set = best_instruction_set());

// The shipped converter that leads from one model to another in one step; for longer ways see path.hpp.
// Throws kUsage if there is none.
const Converter& find_converter(const std::string& source_model, const std::string& target_model,
                                InstructionSet set = best_instruction_set());

}  // namespace remap
