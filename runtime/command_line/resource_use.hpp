// What this process has taken of the machine.
#pragma once

#include <cstddef>

namespace remap {

struct ResourceUse {
  double processor_seconds = 0.0;     // of all threads
  std::size_t peak_memory_bytes = 0;  // resident
};

// Since the process began.
ResourceUse resource_use() noexcept;

}  // namespace remap
