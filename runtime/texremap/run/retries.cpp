#include "texremap/run/retries.hpp"

#include <chrono>
#include <thread>

#include "command_line/interruption.hpp"
#include "core/errors.hpp"

namespace remap {
namespace {

constexpr std::size_t kMostRepeats = 3;

void wait_before_repeat(std::size_t repeat) {
  for (int i = 0; i < 5 << repeat && !interruption(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace

std::vector<std::string> with_retries(const std::function<void()>& work) {
  std::vector<std::string> troubles;
  for (;;) try {
      work();
      return troubles;
    } catch (const Error& error) {
      if (!is_transient(error.system_code()) || troubles.size() == kMostRepeats || interruption()) throw;
      wait_before_repeat(troubles.size());
      troubles.emplace_back(error.what());
    }
}

}  // namespace remap
