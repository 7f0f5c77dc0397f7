#include "stages/kernels.hpp"

#include <algorithm>
#include <array>

#include "core/plain_text.hpp"
#include "remap/converter.hpp"
#include "remap/error.hpp"

namespace remap {

extern const Kernels baseline_kernels;
#if REMAP_HAS_X86_SETS
extern const Kernels avx2_kernels, avx512_kernels;
#endif

const Kernels& kernels(InstructionSet set) {
#if REMAP_HAS_X86_SETS
  if (set == InstructionSet::kAvx512) return avx512_kernels;
  if (set == InstructionSet::kAvx2) return avx2_kernels;
#endif
  static_cast<void>(set);
  return baseline_kernels;
}

namespace {

constexpr std::array<InstructionSet, 3> kSets = {InstructionSet::kBaseline, InstructionSet::kAvx2,
                                                 InstructionSet::kAvx512};

}  // namespace

std::string_view instruction_set_name(InstructionSet set) {
  switch (set) {
    case InstructionSet::kBaseline:
      return "baseline";
    case InstructionSet::kAvx2:
      return "avx2";
    case InstructionSet::kAvx512:
      return "avx512";
  }
  return "baseline";
}

InstructionSet best_instruction_set() {
#if REMAP_HAS_X86_SETS
  if (!__builtin_cpu_supports("avx2")) return InstructionSet::kBaseline;
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
  return avx512 ? InstructionSet::kAvx512 : InstructionSet::kAvx2;
#else
  return InstructionSet::kBaseline;
#endif
}

std::vector<InstructionSet> instruction_sets(InstructionSet best) {
  std::vector<InstructionSet> sets(kSets.begin(), kSets.end());
  std::erase_if(sets, [best](InstructionSet set) { return set > best; });
  return sets;
}

InstructionSet instruction_set_from_name(const std::string& context, const std::string& name,
                                         InstructionSet best) {
  std::vector<std::string> names;
  for (const InstructionSet set : kSets) names.emplace_back(instruction_set_name(set));
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw Error(ErrorKind::kUsage,
                context + ": unknown instruction set '" + name + "'" + suggestion(name, names));
  const InstructionSet set = kSets[static_cast<std::size_t>(found - names.begin())];
  if (set > best)
    throw Error(ErrorKind::kUsage, context + ": this processor does not support " + name + " (choose " +
                                       std::string(instruction_set_name(best)) + " or less)");
  return set;
}

}  // namespace remap
