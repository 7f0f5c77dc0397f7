// For tests that train or search: how long they took, and whether this build is slow enough to do less.
#pragma once

#include <chrono>
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

inline double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace remap
