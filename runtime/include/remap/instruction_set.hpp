// The instruction sets that converters are built for, and which of them this processor has.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace remap {

// Each holds the ones before it. Elsewhere than on x86-64 there is the baseline only.
enum class InstructionSet {
  kBaseline,  // what the whole program is compiled for
  kAvx2,
  kAvx512,  // F, VL, BW and DQ: Intel's servers since 2017, AMD's processors since 2022
};

// `baseline`, `avx2`, `avx512`: the word on the command line and in JSON.
std::string_view instruction_set_name(InstructionSet set);

// The widest that this processor, its operating system and this build have.
InstructionSet best_instruction_set();

// All up to `best`, from the baseline.
std::vector<InstructionSet> instruction_sets(InstructionSet best = best_instruction_set());

// The set of that name. Throws kUsage, as from `place`, where there is no such set or it is beyond `best`.
InstructionSet instruction_set_from_name(const std::string& place, const std::string& name,
                                         InstructionSet best = best_instruction_set());

}  // namespace remap
