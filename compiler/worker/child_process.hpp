// This file runs another program. It exchanges lines with this program, keeps the end of its log, and never
// leaves it running.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <thread>

namespace remap {

class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;

  enum class Reading {
    kLine,   // a line was read
    kEnded,  // the process has ended and all its output was read
    kLate,   // nothing arrived in time
  };

  // Starts `script` by /bin/sh, in its own process group, so that Ctrl-C at the terminal does not reach it.
  // The kernel kills the process when this program ends in any way. The process and everything that it starts
  // have the environment variable REMAP_CHILD, by which processes that left the group are found. Throws
  // kInput if it cannot be started.
  explicit ChildProcess(std::string script);

  // Closes the input of the process, waits up to `kGrace` until it ends, and then calls end(). Descendants
  // that clear their environment are not found. If somebody kills this program, only the process itself ends,
  // not its descendants.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Returns false if the process no longer reads.
  bool write_line(const std::string& line);

  // Reads the next line of the process's standard output, without the line break.
  Reading read_line(Clock::time_point deadline, std::string* line);

  // Adds a line of output that is not an answer to the log.
  void note(const std::string& line);

  // Describes how the process ended: `died with signal 9` or `ended with exit code 3`. If it still runs,
  // returns `closed its input`.
  std::string ending();

  // Returns the last lines of the process's standard error as `A | B | C`, or an empty text.
  std::string log_end();

  // Asks the group to end (SIGTERM), so that a program such as srun can end what it runs on other machines.
  // After `kGrace`, kills the group and everything else that the process has started. Does not wait.
  void end();

  static constexpr std::chrono::milliseconds kGrace{2000};

 private:
  void start_and_watch(const std::string& script);
  void watch();
  void end_if_due();
  void leave_at(Clock::time_point time);
  void take_output(std::string_view bytes);
  void stop_for(const char* fault);
  void take_log(std::string_view bytes);
  void reap();

  int input_ = -1, output_ = -1, errors_ = -1;  // this program's ends of the pipes
  pid_t id_ = -1;
  std::string mark_;  // REMAP_CHILD=...
  std::thread watcher_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool started_ = false;
  int start_failure_ = 0;
  std::deque<std::string> lines_;
  std::size_t unread_ = 0;  // size of these lines in bytes
  std::string part_of_line_, log_;
  bool ended_ = false, asked_ = false;
  const char* fault_ = nullptr;  // reason why the process was killed and its output ignored
  int status_ = 0;
  Clock::time_point leave_by_ = Clock::time_point::max();
};

}  // namespace remap
