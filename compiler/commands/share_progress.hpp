// Progress of work that reports its share, and its interruption by a signal.
#pragma once

#include <string>

#include "command_line/progress.hpp"

namespace remapc {

// Shows a progress line `<command> <probed_model>` while it exists, and makes SIGINT and SIGTERM stop the
// work. Pass it by std::ref where a FitProgress is expected.
class ShareProgress {
 public:
  ShareProgress(const std::string& command, const std::string& probed_model);

  // `share` of the work is finished, 0 to 1. Throws kInterrupted after a signal.
  void operator()(double share);

 private:
  std::string command_;
  remap::Progress progress_;
};

}  // namespace remapc
