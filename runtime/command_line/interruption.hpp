// This file turns requests to stop (SIGINT, SIGTERM, SIGHUP, SIGPIPE) into a flag that long work polls.
#pragma once

#include <atomic>

namespace remap {

// After this call, the first of these signals sets the flag and does not end the process. So the run can
// remove its unfinished files. A second SIGINT, SIGTERM or SIGHUP ends the process. If the program was
// started so that it ignores a signal (nohup), it still ignores it. Further calls do nothing.
void watch_interruptions();

// Returns true after such a signal.
const std::atomic<bool>& interruption() noexcept;

}  // namespace remap
