// This file serves tests that train or search. It measures the time of these tests. It also detects slow
// builds, in which they do less.
#pragma once

#include <ctime>
#include <functional>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define REMAP_SLOW_BUILD
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define REMAP_SLOW_BUILD
#endif

namespace remap {

// This build uses a sanitizer.
#ifdef REMAP_SLOW_BUILD
inline constexpr bool kSlowBuild = true;
#else
inline constexpr bool kSlowBuild = false;
#endif

// Returns processor time, because other programs on the machine must not count.
inline double seconds_of(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace remap
