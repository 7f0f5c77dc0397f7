// This file shows the progress of a run as a line on the terminal, and turns requests to stop (SIGINT,
// SIGTERM, SIGHUP, SIGPIPE) into a flag that long work polls.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "command_line/run_app.hpp"

namespace remap {

// Returns `1:05:00` for an hour and five minutes, and `0:13` for 13 seconds.
std::string clock_text(double seconds);

// Shows `label  42 %, 0:13 left` on standard error, updates it at most ten times a second, and erases it when
// destroyed. Prints nothing if standard error is not a terminal. Thread-safe.
class Progress {
 public:
  // `total` is the number of work units, which may be 0. If `shown` is false, nothing is printed.
  Progress(std::string label, std::size_t total, bool shown = true);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Reports that `done` units of `total` are finished. A smaller count than before is ignored.
  void advance_to(std::size_t done);
  // Reports that `count` more units are finished.
  void advance(std::size_t count = 1);
  // Changes the label.
  void relabel(std::string label);
  // Erases the line to make room for other output. The next update shows it again.
  void hide();

 private:
  using Clock = std::chrono::steady_clock;
  void show_in_time();
  void show(Clock::time_point now);

  std::string label_;
  const std::size_t total_;
  const bool shown_;
  const Clock::time_point start_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  bool line_is_up_ = false;
  Clock::time_point last_shown_;
};

// After this call, the first of these signals sets the flag and does not end the process. So the run can
// remove its unfinished files. A second SIGINT, SIGTERM or SIGHUP ends the process. If the program was
// started so that it ignores a signal (nohup), it still ignores it. Further calls do nothing.
void watch_interruptions();

// Returns true after such a signal.
const std::atomic<bool>& interruption() noexcept;

}  // namespace remap
