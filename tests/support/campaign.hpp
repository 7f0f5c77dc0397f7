// This file decides how long a test of random cases runs.
#pragma once

#include <cstdlib>
#include <string>

#include "support/build_speed.hpp"

namespace remap {

// `scripts/test campaign` sets REMAP_CAMPAIGN=full.
inline bool is_full_campaign() {
  const char* length = std::getenv("REMAP_CAMPAIGN");
  return length != nullptr && std::string(length) == "full";
}

// Returns `full` in a full campaign, and otherwise a tenth of it. Under a sanitizer, it always returns a
// tenth. A test that uses either function has the tag [campaign].
inline int campaign_length(int full) { return is_full_campaign() && !kSlowBuild ? full : full / 10; }

}  // namespace remap
