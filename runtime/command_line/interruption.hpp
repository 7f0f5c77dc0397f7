// Requests to stop the program (SIGINT, SIGTERM), as a flag that long work polls.
#pragma once

#include <atomic>

namespace remap {

// From now on the first SIGINT or SIGTERM sets the flag instead of ending the process; the second one ends
// it.
void watch_interruptions();

// True after such a signal.
const std::atomic<bool>& interruption() noexcept;

}  // namespace remap
