// This file tests which instruction sets exist, and their names on the command line.
#include <catch2/catch.hpp>

#include "remap/converter.hpp"
#include "remap/error.hpp"

using namespace remap;

TEST_CASE("instruction set: names lead back to their sets, up to the best") {
  for (const InstructionSet best :
       {InstructionSet::kBaseline, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    const std::vector<InstructionSet> sets = instruction_sets(best);
    CHECK(sets.front() == InstructionSet::kBaseline);
    CHECK(sets.back() == best);
    for (const InstructionSet set : sets)
      CHECK(instruction_set_from_name("place", std::string(instruction_set_name(set)), best) == set);
  }
}

TEST_CASE("instruction set: one that the processor lacks, or that there is not, is wrong usage") {
  const auto message = [](const std::string& name) -> std::string {
    try {
      instruction_set_from_name("--instructions", name, InstructionSet::kAvx2);
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::kUsage);
      return error.what();
    }
    return "";
  };
  CHECK(message("avx512") == "--instructions: this processor does not support avx512 (choose avx2 or less)");
  CHECK(message("avx") == "--instructions: unknown instruction set 'avx' (did you mean avx2?)");
}
