// The wish of a person or the system that the program stops, as a flag that long work looks at.
#pragma once

#include <atomic>

namespace remap {

// From now on SIGINT and SIGTERM set the flag instead of ending the process, once: the second signal ends it.
void watch_interruptions();

// Set when the program was asked to stop.
const std::atomic<bool>& interruption() noexcept;

}  // namespace remap
