#include "commands/share_progress.hpp"

#include "command_line/interruption.hpp"
#include "remap/error.hpp"

namespace remapc {
namespace {

constexpr std::size_t kUnits = 1000;

}  // namespace

ShareProgress::ShareProgress(const std::string& command, const std::string& probed_model)
    : command_(command), progress_(command + " " + probed_model, kUnits) {
  remap::watch_interruptions();
}

void ShareProgress::operator()(double share) {
  if (remap::interruption())
    throw remap::Error(remap::ErrorKind::kInterrupted, command_ + ": interrupted; nothing was written");
  progress_.advance_to(static_cast<std::size_t>(static_cast<double>(kUnits) * share));
}

}  // namespace remapc
