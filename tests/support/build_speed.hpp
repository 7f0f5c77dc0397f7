// For tests that train or search: how long they took, and whether this build is slow enough to do less.
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

// Under a sanitizer.
#ifdef REMAP_SLOW_BUILD
inline constexpr bool kSlowBuild = true;
#else
inline constexpr bool kSlowBuild = false;
#endif

// Of processor time: other programs on the machine do not count.
inline double seconds_of(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace remap
