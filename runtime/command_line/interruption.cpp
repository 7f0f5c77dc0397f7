#include "command_line/interruption.hpp"

#include "core/system.hpp"

namespace remap {
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
