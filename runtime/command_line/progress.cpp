#include "command_line/progress.hpp"

#include <cstdio>
#include <utility>

#include "core/system.hpp"

namespace remap {
namespace {

constexpr std::chrono::milliseconds kInterval{100};

}  // namespace

std::string clock_text(double seconds) {
  const long whole = static_cast<long>(seconds + 0.5);
  const long hours = whole / 3600, minutes = whole / 60 % 60;
  char text[64];
  if (hours > 0)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", hours, minutes, whole % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld", minutes, whole % 60);
  return text;
}

Progress::Progress(std::string label, std::size_t total, bool shown)
    : label_(std::move(label)),
      total_(total),
      shown_(shown && total > 0 && terminal_watches_errors()),
      start_(Clock::now()),
      last_shown_(start_) {}

Progress::~Progress() { hide(); }

void Progress::hide() {
  const std::lock_guard lock(mutex_);
  if (line_is_up_) std::fputs("\r\033[K", stderr);  // moves to the start of the line and erases it
  line_is_up_ = false;
}

void Progress::advance_to(std::size_t done) {
  const std::lock_guard lock(mutex_);
  if (done <= done_) return;
  done_ = done;
  show_in_time();
}

void Progress::advance(std::size_t count) {
  const std::lock_guard lock(mutex_);
  done_ += count;
  show_in_time();
}

void Progress::relabel(std::string label) {
  const std::lock_guard lock(mutex_);
  label_ = std::move(label);
  show_in_time();
}

void Progress::show_in_time() {
  const Clock::time_point now = Clock::now();
  if (shown_ && now - last_shown_ >= kInterval) show(now);
}

void Progress::show(Clock::time_point now) {
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const std::string left = done_ == 0 ? "" : ", " + clock_text(elapsed * (1.0 - share) / share) + " left";
  std::fprintf(stderr, "\r\033[K%s  %.0f %%%s", label_.c_str(), 100.0 * share, left.c_str());
  std::fflush(stderr);
  last_shown_ = now;
  line_is_up_ = true;
}

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only write lock-free atomics");

extern "C" void note_interruption(int) { interrupted.store(true, std::memory_order_relaxed); }

}  // namespace

void watch_interruptions() {
  // Only the first call installs the handler. A second call would ignore the second signal, which must end
  // the process.
  static std::atomic_flag is_watching;
  if (is_watching.test_and_set()) return;
  watch_signals(note_interruption);
}

const std::atomic<bool>& interruption() noexcept { return interrupted; }

}  // namespace remap
