#include "command_line/interruption.hpp"

#include <csignal>

namespace remap {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only write lock-free atomics");

extern "C" void note_interruption(int) { interrupted.store(true, std::memory_order_relaxed); }

void watch(int signal, unsigned flags) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  if (action.sa_handler == SIG_IGN) return;  // the program was started to ignore it (nohup)
  action = {};
  action.sa_handler = note_interruption;
  action.sa_flags = static_cast<int>(flags | SA_RESTART);
  sigaction(signal, &action, nullptr);
}

}  // namespace

void watch_interruptions() {
  // A second call must not swallow a second signal.
  static std::atomic_flag is_watching;
  if (is_watching.test_and_set()) return;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) watch(signal, SA_RESETHAND);
  // Nobody reads the output any more. Every further write fails with the same signal, which must not end the
  // process before it has cleaned up.
  watch(SIGPIPE, 0);
}

const std::atomic<bool>& interruption() noexcept { return interrupted; }

}  // namespace remap
