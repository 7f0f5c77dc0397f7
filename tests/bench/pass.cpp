// One build of the pass; PASS_NAME and the flags come from CMake. The header's functions are inline: a
// namespace of its own keeps the linker from merging the builds.
#include "bench/pass.hpp"

#include <cstdint>
#include <cstring>

#define remap PASS_NAMESPACE
#include "mitsuba_ward_to_mitsuba_as.hpp"
#undef remap

namespace remap_bench {

std::size_t PASS_NAME(std::size_t count, const float* width, const std::array<const float*, 3>& specular,
                      float* width_out, const std::array<float*, 3>& specular_out) {
  return PASS_NAMESPACE::mitsuba_ward_to_mitsuba_as::evaluate_batch<3>(count, width, specular, width_out,
                                                                       specular_out);
}

}  // namespace remap_bench
