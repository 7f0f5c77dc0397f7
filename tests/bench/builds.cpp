#include "bench/builds.hpp"

#include <type_traits>

namespace remap_bench {

// These declare the functions that CMake built.
#define REMAP_BUILD(Function, name, code, flags) std::remove_pointer_t<Function> name;
#include "builds.inc"
#undef REMAP_BUILD

namespace {

bool can_run(const std::string& flags) {
#if defined(__x86_64__)
  if (flags == "avx2") return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (flags == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#endif
  return flags == "o2" || flags == "o3";
}

// Returns the builds of one kind that this processor can run.
template <typename Function>
std::vector<Build<Function>> runnable() {
  std::vector<Build<Function>> found;
  const auto consider = [&](const std::string& code, const std::string& flags, auto function) {
    if constexpr (std::is_same_v<decltype(function), Function>)
      if (can_run(flags)) found.push_back({code, flags, function});
  };
#define REMAP_BUILD(Function, name, code, flags) consider(#code, #flags, &name);
#include "builds.inc"
#undef REMAP_BUILD
  return found;
}

}  // namespace

std::vector<Build<Pass>> pass_builds() { return runnable<Pass>(); }
std::vector<Build<MaterialPass>> material_builds() { return runnable<MaterialPass>(); }

std::string flags_text(const std::string& flags) {
  if (flags == "o2") return "-O2";
  if (flags == "o3") return "-O3";
  return flags == "avx2" ? "AVX2" : "AVX-512";
}

}  // namespace remap_bench
