#include "command_line/interruption.hpp"

#include <csignal>

namespace remap {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only write lock-free atomics");

extern "C" void note_interruption(int) { interrupted.store(true, std::memory_order_relaxed); }

void watch(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  if (action.sa_handler == SIG_IGN) return;  // the program was started to ignore it (nohup)
  action = {};
  action.sa_handler = note_interruption;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(signal, &action, nullptr);
}

}  // namespace

void watch_interruptions() {
  watch(SIGINT);
  watch(SIGTERM);
}

const std::atomic<bool>& interruption() noexcept { return interrupted; }

}  // namespace remap
