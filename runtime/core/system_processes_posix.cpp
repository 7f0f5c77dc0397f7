#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/system.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

int own_process() { return ::getpid(); }

bool has_ended(int process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

std::string machine_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::uint64_t memory_size() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && bytes > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(bytes) : 0;
}

fs::path program_file() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored);
}

std::optional<ProcessCopy> copy_process(const std::function<void(int)>& serve) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return std::nullopt;
  std::fflush(nullptr);
  const int parent = ::getpid(), process = ::fork();
  if (process != 0) {
    ::close(ends[1]);
    if (process < 0) ::close(ends[0]);
    return process < 0 ? std::nullopt : std::make_optional(ProcessCopy{process, ends[0]});
  }
  ::close(ends[0]);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() == parent) serve(ends[1]);
  std::fflush(nullptr);
  // _exit does not destroy the objects of the program and its libraries, which belong to the other process
  ::_exit(0);
}

std::string end_of(const ProcessCopy& copy) {
  // Closing would not suffice, because later copies have this end of the stream, too.
  ::shutdown(copy.descriptor, SHUT_RDWR);
  ::close(copy.descriptor);
  int status = 0;
  while (::waitpid(copy.process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFSIGNALED(status)) return "with exit code " + std::to_string(WEXITSTATUS(status));
  return "by signal " + std::to_string(WTERMSIG(status)) + " (" + ::strsignal(WTERMSIG(status)) + ")";
}

void interrupt(const ProcessCopy& copy) { ::kill(copy.process, SIGTERM); }

bool send_all(int descriptor, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ::ssize_t count = ::send(descriptor, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

std::vector<bool> wait_to_read(const std::vector<int>& descriptors) {
  constexpr int kMilliseconds = 100;
  std::vector<::pollfd> polled;
  for (const int descriptor : descriptors) polled.push_back({descriptor, POLLIN, 0});
  const bool has_some = ::poll(polled.data(), polled.size(), kMilliseconds) > 0;
  std::vector<bool> readable;
  for (const ::pollfd& one : polled) readable.push_back(has_some && one.revents != 0);
  return readable;
}

ResourceUse resource_use() noexcept {
  constexpr std::size_t kUnit = 1024;  // Linux reports kilobytes
  ResourceUse use;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    if (::getrusage(who, &usage) != 0) continue;
    use.processor_seconds += seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    use.peak_memory_bytes =
        std::max(use.peak_memory_bytes, static_cast<std::size_t>(usage.ru_maxrss) * kUnit);
  }
  return use;
}

}  // namespace remap
