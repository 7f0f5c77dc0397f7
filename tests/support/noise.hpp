// This file makes values of texels that look random.
#pragma once

#include <cstdint>

namespace remap {

// Returns a repeatable value in [0, 1) for a texel and a channel, by the finaliser of SplitMix64 (Steele, Lea
// and Flood, 2014).
inline float noise(int x, int y, int channel) {
  std::uint64_t state = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u +
                        static_cast<std::uint64_t>(y) * 0xd1b54a32d192ed03u +
                        static_cast<std::uint64_t>(channel) * 0x8cb92ba72f3d8dd7u;
  state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
  state = (state ^ (state >> 27)) * 0x94d049bb133111ebu;
  return static_cast<float>((state ^ (state >> 31)) >> 40) * 0x1p-24f;
}

}  // namespace remap
