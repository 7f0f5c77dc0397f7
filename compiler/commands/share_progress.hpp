// This file shows the progress of work that reports its fraction, and lets a signal interrupt it.
#pragma once

#include <string>

#include "command_line/progress.hpp"
#include "remap/error.hpp"

namespace remap {

// A ShareProgress shows a progress line `<command> <subject>` while it exists. Meanwhile, signals stop the
// work (progress.hpp). Where a FitProgress is expected, pass it by std::ref.
class ShareProgress {
 public:
  ShareProgress(const std::string& command, const std::string& subject)
      : command_(command), progress_(command + " " + subject, kUnits) {
    watch_interruptions();
  }

  // Shows that `share` of the work is finished, 0 to 1. Throws kInterrupted after a signal.
  void operator()(double share) {
    if (interruption()) throw Error(ErrorKind::kInterrupted, command_ + ": interrupted; nothing was written");
    progress_.advance_to(static_cast<std::size_t>(static_cast<double>(kUnits) * share));
  }

 private:
  static constexpr std::size_t kUnits = 1000;
  std::string command_;
  Progress progress_;
};

}  // namespace remap
