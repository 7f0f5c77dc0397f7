#include "command_line/resource_use.hpp"

#include <sys/resource.h>

namespace remap {
namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ResourceUse resource_use() noexcept {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return {};
  constexpr std::size_t kUnit = 1024;  // Linux counts in kilobytes
  return {seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime),
          static_cast<std::size_t>(usage.ru_maxrss) * kUnit};
}

}  // namespace remap
