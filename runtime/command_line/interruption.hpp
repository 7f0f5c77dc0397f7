// This file turns requests to stop (SIGINT, SIGTERM, SIGHUP, SIGPIPE) into a flag that long work polls.
#pragma once

#include <atomic>

namespace remap {

// From now on the first of these signals sets the flag instead of ending the process, so that the run can
// remove its unfinished files. The second SIGINT, SIGTERM or SIGHUP ends the process. Signals that the
// program was started to ignore (nohup) are ignored. Further calls do nothing.
void watch_interruptions();

// Returns true after such a signal.
const std::atomic<bool>& interruption() noexcept;

}  // namespace remap
