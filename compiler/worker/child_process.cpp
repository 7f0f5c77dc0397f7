// This file runs child processes. Each child has a thread that forks it, reads its output and reaps it. When
// this thread dies, the kernel tells the child that its parent is dead. So the thread must live as long as
// the child.
#include "worker/child_process.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "core/plain_text.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

constexpr std::size_t kMostLog = 8192;          // bytes of standard error that are stored
constexpr std::size_t kShownLogLines = 4;       // lines of the log in a message
constexpr std::size_t kLongestLine = 16 << 20;  // far above an answer of a few kilobytes
constexpr std::size_t kMostUnread = 64 << 20;   // bytes of lines that wait to be read
constexpr int kWatchMilliseconds = 20;          // longest delay until somebody notices the end of a process

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw input_error(std::string("pipe: cannot be created: ") + std::strerror(errno));
    read = ends[0], write = ends[1];
  }
};

void close_end(int* end) {
  if (*end >= 0) ::close(*end);
  *end = -1;
}

// Returns the memory of a waiting line. Empty lines take memory, too.
std::size_t bytes_of(const std::string& line) { return sizeof line + line.size(); }

// Runs between fork and exec, so it makes only async-signal-safe calls.
[[noreturn]] void become(pid_t parent, char* const* arguments, int input, int output, int errors) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // the parent died before the signal was set up
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  ::execv(arguments[0], arguments);
  ::_exit(127);
}

// Returns `REMAP_CHILD=5d1c09e4-421-1` for the first child of this process.
std::string new_mark() {
  static std::atomic<unsigned> count{0};
  return "REMAP_CHILD=" + owner_tag() + "-" + std::to_string(++count);
}

// Returns true if the environment that a process began with holds `entry`, and false if it cannot be read.
bool has_in_environment(const std::filesystem::path& process, const std::string& entry) {
  try {
    const std::vector<std::string> entries = parts_between(read_file(process / "environ"), '\0');
    return std::ranges::find(entries, entry) != entries.end();
  } catch (const Error&) {
    return false;
  }
}

// Returns the processes that have `mark` in their environment.
std::vector<pid_t> marked_processes(const std::string& mark) {
  std::vector<pid_t> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
    const std::string name = entry.path().filename().string();
    const bool is_process = name.find_first_not_of("0123456789") == std::string::npos;
    if (is_process && has_in_environment(entry.path(), mark)) found.push_back(std::stoi(name));
  }
  return found;
}

// Kills processes that left the group (setsid), and repeats this while they start new processes. Dead
// processes and zombies have no environment, so they are not found.
void kill_marked(const std::string& mark) {
  constexpr int kMostRounds = 100;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<pid_t> processes = marked_processes(mark);
    if (processes.empty()) return;
    for (const pid_t process : processes) ::kill(process, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// A PipeSignalBlocked blocks and consumes SIGPIPE. This signal is raised when the program writes to a process
// that has ended, and it would end the program.
class PipeSignalBlocked {
 public:
  PipeSignalBlocked() {
    ::sigemptyset(&signal_);
    ::sigaddset(&signal_, SIGPIPE);
    sigset_t pending;
    ::sigpending(&pending);
    was_pending_ = ::sigismember(&pending, SIGPIPE) == 1;
    ::pthread_sigmask(SIG_BLOCK, &signal_, &before_);
  }
  ~PipeSignalBlocked() {
    const timespec at_once{0, 0};
    if (!was_pending_) {
      while (::sigtimedwait(&signal_, nullptr, &at_once) < 0 && errno == EINTR) {
      }
    }
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  PipeSignalBlocked(const PipeSignalBlocked&) = delete;
  PipeSignalBlocked& operator=(const PipeSignalBlocked&) = delete;

 private:
  sigset_t signal_{}, before_{};
  bool was_pending_ = false;
};

}  // namespace

ChildProcess::ChildProcess(std::string script) : mark_(new_mark()) {
  script = mark_ + "; export REMAP_CHILD; " + script;
  watcher_ = std::thread([this, text = std::move(script)] { start_and_watch(text); });
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return started_; });
  if (start_failure_ == 0) return;
  lock.unlock();
  watcher_.join();
  throw input_error(std::string("process: cannot be started: ") + std::strerror(start_failure_));
}

ChildProcess::~ChildProcess() {
  {
    const std::lock_guard lock(mutex_);
    close_end(&input_);
    leave_at(Clock::now() + kGrace);
  }
  watcher_.join();
  close_end(&output_);
  close_end(&errors_);
}

void ChildProcess::start_and_watch(const std::string& script) {
  const pid_t parent = ::getpid();
  std::string shell = "/bin/sh", option = "-c", text = script;
  const std::array<char*, 4> arguments = {shell.data(), option.data(), text.data(), nullptr};
  int failure = 0;
  try {
    Pipe input, output, errors;
    id_ = ::fork();
    if (id_ == 0) become(parent, arguments.data(), input.read, output.write, errors.write);
    failure = id_ < 0 ? errno : 0;
    if (id_ > 0) ::setpgid(id_, id_);  // both processes call this; only the first call has an effect
    for (int end : {input.read, output.write, errors.write}) ::close(end);
    input_ = input.write;
    output_ = output.read;
    errors_ = errors.read;
  } catch (const Error&) {
    failure = errno != 0 ? errno : EMFILE;
  }
  {
    const std::lock_guard lock(mutex_);
    started_ = true;
    start_failure_ = failure;
  }
  changed_.notify_all();
  if (failure == 0) watch();
}

// Reads both streams until the process has ended or must be ended.
void ChildProcess::watch() {
  std::array<pollfd, 2> streams = {pollfd{output_, POLLIN, 0}, pollfd{errors_, POLLIN, 0}};
  std::vector<char> buffer(1 << 16);
  bool gone = false;
  for (;;) {
    const int ready = ::poll(streams.data(), streams.size(), gone ? 0 : kWatchMilliseconds);
    bool read_something = false;
    for (pollfd& stream : streams) {
      if (ready <= 0 || stream.fd < 0 || stream.revents == 0) continue;
      const ssize_t count = ::read(stream.fd, buffer.data(), buffer.size());
      if (count > 0) {
        const std::string_view bytes(buffer.data(), static_cast<std::size_t>(count));
        stream.fd == output_ ? take_output(bytes) : take_log(bytes);
        read_something = true;
      } else if (count == 0) {
        stream.fd = -1;  // poll ignores negative descriptors
      }
    }
    // Stop after reading all output of an ended process, or if a fault makes the output useless.
    if (gone && (!read_something || fault_ != nullptr)) break;
    siginfo_t info{};
    gone = ::waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == id_;
    const std::lock_guard lock(mutex_);
    // Kill the child's own children before the child is reaped. Until then, no other process group can get
    // its number.
    if (gone)
      ::kill(-id_, SIGKILL);
    else
      end_if_due();
  }
  reap();
}

void ChildProcess::leave_at(Clock::time_point time) { leave_by_ = std::min(leave_by_, time); }

void ChildProcess::end_if_due() {
  if (Clock::now() < leave_by_) return;
  ::kill(-id_, asked_ ? SIGKILL : SIGTERM);
  asked_ = true;
  leave_by_ = Clock::now() + kGrace;
}

void ChildProcess::reap() {
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  kill_marked(mark_);
  const std::lock_guard lock(mutex_);
  status_ = status;
  ended_ = true;
  changed_.notify_all();
}

void ChildProcess::take_output(std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  if (fault_ != nullptr) return;
  part_of_line_ += bytes;
  std::size_t start = 0;
  for (std::size_t end; (end = part_of_line_.find('\n', start)) != std::string::npos; start = end + 1) {
    lines_.push_back(part_of_line_.substr(start, end - start));
    unread_ += bytes_of(lines_.back());
  }
  part_of_line_.erase(0, start);
  if (part_of_line_.size() > kLongestLine) stop_for("wrote a line of more than 16 MB");
  if (unread_ > kMostUnread) stop_for("wrote more than 64 MB of lines that no request asked for");
  changed_.notify_all();
}

// Kills the group. From here on, drops its output, because processes outside of the group may still write.
void ChildProcess::stop_for(const char* fault) {
  fault_ = fault;
  lines_.clear();
  part_of_line_ = std::string();
  ::kill(-id_, SIGKILL);
}

void ChildProcess::take_log(std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  for (const char c : bytes) log_ += c == '\n' || c < 0 || c >= ' ' ? c : ' ';
  if (log_.size() > kMostLog) log_.erase(0, log_.size() - kMostLog);
}

bool ChildProcess::write_line(const std::string& line) {
  const PipeSignalBlocked blocked;
  const std::string bytes = line + "\n";
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(input_, bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

ChildProcess::Reading ChildProcess::read_line(Clock::time_point deadline, std::string* line) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [&] { return !lines_.empty() || ended_; });
  if (lines_.empty()) return ended_ ? Reading::kEnded : Reading::kLate;
  unread_ -= bytes_of(lines_.front());
  *line = std::move(lines_.front());
  lines_.pop_front();
  return Reading::kLine;
}

void ChildProcess::note(const std::string& line) { take_log(line + "\n"); }

std::string ChildProcess::ending() {
  const std::lock_guard lock(mutex_);
  if (fault_ != nullptr) return fault_;
  if (!ended_) return "closed its input";
  if (WIFSIGNALED(status_)) return "died with signal " + std::to_string(WTERMSIG(status_));
  return "ended with exit code " + std::to_string(WEXITSTATUS(status_));
}

std::string ChildProcess::log_end() {
  const std::lock_guard lock(mutex_);
  std::deque<std::string> shown;
  std::size_t end = log_.size();
  while (end > 0 && shown.size() < kShownLogLines) {
    const std::size_t line_break = log_.rfind('\n', end - 1);
    const std::size_t start = line_break == std::string::npos ? 0 : line_break + 1;
    if (start < end) shown.push_front(log_.substr(start, end - start));
    end = line_break == std::string::npos ? 0 : line_break;
  }
  std::string text;
  for (const std::string& line : shown) text += (text.empty() ? "" : " | ") + line;
  return text;
}

void ChildProcess::end() {
  const std::lock_guard lock(mutex_);
  leave_at(Clock::now());
}

}  // namespace remap
