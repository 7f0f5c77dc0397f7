// This file tests signals that ask a program to stop. Each case runs in a separate process.
#include <csignal>
#include <functional>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "command_line/progress.hpp"

using namespace remap;

namespace {

// Runs `work` in a child process. Returns its exit code, or minus the signal that ended it.
int end_of(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    // Catch2 installs handlers here, and the test may run under nohup.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
    ::_exit(work());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

TEST_CASE("interruption: the first signal sets the flag, the second ends the process") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto once = [&] {
      watch_interruptions();
      if (interruption()) return 1;
      std::raise(signal);
      return interruption() ? 0 : 2;
    };
    CHECK(end_of(once) == 0);
    CHECK(end_of([&] {
            once();
            watch_interruptions();  // a command may call it again when it starts another part of its work
            std::raise(signal);
            return 0;
          }) == -signal);
  }
}

TEST_CASE("interruption: whoever writes to a pipe that nobody reads can still clean up") {
  CHECK(end_of([] {
          watch_interruptions();
          int ends[2];
          if (::pipe(ends) != 0) return 1;
          ::close(ends[0]);
          for (int i = 0; i < 3; ++i)
            if (::write(ends[1], "x", 1) == 1) return 2;
          return interruption() ? 0 : 3;
        }) == 0);
}

TEST_CASE("interruption: a program under nohup goes on") {
  CHECK(end_of([] {
          std::signal(SIGHUP, SIG_IGN);
          watch_interruptions();
          std::raise(SIGHUP);
          return interruption() ? 1 : 0;
        }) == 0);
}
