// Requests to stop the program (SIGINT, SIGTERM, SIGHUP, SIGPIPE), as a flag that long work polls.
#pragma once

#include <atomic>

namespace remap {

// From now on the first of these signals sets the flag instead of ending the process, so that what the run
// left on disk is removed; the second SIGINT, SIGTERM or SIGHUP ends it. Signals that the program was started
// to ignore (nohup) are ignored. Further calls do nothing.
void watch_interruptions();

// True after such a signal.
const std::atomic<bool>& interruption() noexcept;

}  // namespace remap
