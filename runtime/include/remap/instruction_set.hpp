// The instruction sets that converters are compiled for, and those of this processor.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace remap {

// Each includes the ones before it. Other processors than x86-64 have the baseline only.
enum class InstructionSet {
  kBaseline,  // that of the whole program
  kAvx2,
  kAvx512,  // F, VL, BW and DQ: Intel's servers since 2017, AMD's processors since 2022
};

// `baseline`, `avx2`, `avx512`: the word on the command line and in JSON.
std::string_view instruction_set_name(InstructionSet set);

// The widest set that this processor, its operating system and this build support.
InstructionSet best_instruction_set();

// All up to `best`, from the baseline.
std::vector<InstructionSet> instruction_sets(InstructionSet best = best_instruction_set());

// The set of that name. Throws kUsage, with `place` at the start of the message, if the name is unknown or
// the set is beyond `best`.
InstructionSet instruction_set_from_name(const std::string& place, const std::string& name,
                                         InstructionSet best = best_instruction_set());

}  // namespace remap
