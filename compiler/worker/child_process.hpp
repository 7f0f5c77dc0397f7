// A program that runs beside this one: lines in, lines out, the end of its log kept, and never left behind.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <thread>

namespace remapc {

class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;

  enum class Reading {
    kLine,   // one was read
    kEnded,  // the process is gone, and so is all that it said
    kLate,   // nothing came in time
  };

  // Starts `script` by /bin/sh, in a process group of its own, which a Ctrl-C at the terminal does not reach.
  // The kernel kills the process when this program dies, however it dies. Throws kInput where nothing can be
  // started.
  explicit ChildProcess(std::string script);

  // Closes its input, gives it `kGrace` to end, and kills its whole group.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // False where the process does not read any more.
  bool write_line(const std::string& line);

  // The next line of its standard output, without the line break.
  Reading read_line(Clock::time_point deadline, std::string* line);

  // A line of output that is none of the conversation: becomes part of the log.
  void note(const std::string& line);

  // How it ended: `died with signal 9`, `ended with exit code 3`; `closed its output` where that is not
  // known.
  std::string ending();

  // The last lines of its standard error, `A | B | C`; empty where it said nothing.
  std::string log_end();

  // Kills the group at once.
  void kill();

  pid_t id() const { return id_; }

  static constexpr std::chrono::milliseconds kGrace{2000};

 private:
  struct Pipes {
    int input = -1, output = -1, errors = -1;  // this side's ends
  };

  void start_and_watch(const std::string& script);
  void watch();
  void take_output(std::string_view bytes);
  void take_log(std::string_view bytes);
  void reap();

  Pipes pipes_;
  pid_t id_ = -1;
  std::thread watcher_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool started_ = false;
  int start_failure_ = 0;
  std::deque<std::string> lines_;
  std::string part_of_line_, log_;
  bool ended_ = false, leaving_ = false, overlong_ = false;
  int status_ = 0;
  Clock::time_point leave_by_;
};

}  // namespace remapc
