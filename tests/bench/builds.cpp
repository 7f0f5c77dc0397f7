#include "bench/builds.hpp"

namespace remap_bench {

#define REMAP_PASS(name, code, flags)                                                     \
  std::size_t name(std::size_t, const float*, const std::array<const float*, 3>&, float*, \
                   const std::array<float*, 3>&);
#define REMAP_MATERIAL(name, code, flags) std::size_t name(std::size_t, const float* const*, float* const*);
#define REMAP_NETWORK(name, code, flags) void name(std::size_t, const float*, float*);
#define REMAP_PRODUCTS(name, code, flags) \
  void name(const NetworkProducts&, std::size_t, const float*, float*);
#include "builds.inc"
#undef REMAP_PASS
#undef REMAP_MATERIAL
#undef REMAP_NETWORK
#undef REMAP_PRODUCTS

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

template <typename Function>
std::vector<Build<Function>> runnable(const std::vector<Build<Function>>& builds) {
  std::vector<Build<Function>> found;
  for (const Build<Function>& build : builds)
    if (can_run(build.flags)) found.push_back(build);
  return found;
}

}  // namespace

std::vector<Build<Pass>> pass_builds() {
  return runnable<Pass>({
#define REMAP_PASS(name, code, flags) {#code, #flags, name},
#define REMAP_MATERIAL(name, code, flags)
#define REMAP_NETWORK(name, code, flags)
#define REMAP_PRODUCTS(name, code, flags)
#include "builds.inc"
#undef REMAP_PASS
#undef REMAP_MATERIAL
#undef REMAP_NETWORK
#undef REMAP_PRODUCTS
  });
}

std::vector<Build<MaterialPass>> material_builds() {
  return runnable<MaterialPass>({
#define REMAP_PASS(name, code, flags)
#define REMAP_MATERIAL(name, code, flags) {#code, #flags, name},
#define REMAP_NETWORK(name, code, flags)
#define REMAP_PRODUCTS(name, code, flags)
#include "builds.inc"
#undef REMAP_PASS
#undef REMAP_MATERIAL
#undef REMAP_NETWORK
#undef REMAP_PRODUCTS
  });
}

std::vector<Build<NetworkPass>> network_builds() {
  return runnable<NetworkPass>({
#define REMAP_PASS(name, code, flags)
#define REMAP_MATERIAL(name, code, flags)
#define REMAP_NETWORK(name, code, flags) {#code, #flags, name},
#define REMAP_PRODUCTS(name, code, flags)
#include "builds.inc"
#undef REMAP_PASS
#undef REMAP_MATERIAL
#undef REMAP_NETWORK
#undef REMAP_PRODUCTS
  });
}

std::vector<Build<ProductsPass>> products_builds() {
  return runnable<ProductsPass>({
#define REMAP_PASS(name, code, flags)
#define REMAP_MATERIAL(name, code, flags)
#define REMAP_NETWORK(name, code, flags)
#define REMAP_PRODUCTS(name, code, flags) {#code, #flags, name},
#include "builds.inc"
#undef REMAP_PASS
#undef REMAP_MATERIAL
#undef REMAP_NETWORK
#undef REMAP_PRODUCTS
  });
}

std::string flags_text(const std::string& flags) {
  if (flags == "o2") return "-O2";
  if (flags == "o3") return "-O3";
  return flags == "avx2" ? "AVX2" : "AVX-512";
}

}  // namespace remap_bench
