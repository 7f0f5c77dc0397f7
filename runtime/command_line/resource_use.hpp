// Processor time and memory that this process has used.
#pragma once

#include <cstddef>

namespace remap {

struct ResourceUse {
  double processor_seconds = 0.0;     // of all threads
  std::size_t peak_memory_bytes = 0;  // resident
};

// The use since the process began; zeros where the system does not report it.
ResourceUse resource_use() noexcept;

}  // namespace remap
