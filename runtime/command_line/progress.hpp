// A line that tells a waiting person how far the work is.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "command_line/run_app.hpp"

namespace remap {

// Keeps `label  42 %, 0:13 left` up to date on standard error, at most ten times a second, and takes the
// line away when destroyed. Silent where standard error is no terminal. Safe to call from many threads.
class Progress {
 public:
  // `total`: units of work until done, 0 where nothing is to be done. `shown` = false silences it.
  Progress(std::string label, std::size_t total, bool shown = true);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `done` units of `total` are ready. A smaller count than before is ignored.
  void advance_to(std::size_t done);
  // `count` more units are ready.
  void advance(std::size_t count = 1);
  // What the line says from now on.
  void relabel(std::string label);

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

}  // namespace remap
