#include "support/process.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <linux/capability.h>
#include <sstream>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "support/loaded_program.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// Runs between fork and exec, so it makes only calls that are safe there.
[[noreturn]] void become(char* const* arguments, const ProcessStart& start, bool keeps_permissions) {
  enter(start);
  // exec does not restore the rights that root drops here. Other users have no such rights, and the call
  // fails for them.
  if (keeps_permissions)
    for (const int right : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH}) ::prctl(PR_CAPBSET_DROP, right, 0, 0, 0);
  ::execv(arguments[0], arguments);
  ::_exit(127);
}

}  // namespace

std::string ProcessResult::last_error() const {
  std::string text = errors;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t line = text.rfind('\n');
  return line == std::string::npos ? text : text.substr(line + 1);
}

// Uses exec, because only exec takes rights away from root; a copy would keep them.
Process::Process(const Words& arguments, const ProcessLimits& limits)
    : is_copy_(is_loaded(arguments[0]) && !limits.keeps_permissions) {
  ProcessStart start{arguments, limits.folder, folder_.path() / "output", folder_.path() / "errors",
                     limits.file_bytes.value_or(RLIM_INFINITY)};
  if (is_copy_) {
    pid_ = start_loaded(start);
    return;
  }
  std::vector<char*> pointers;
  for (std::string& word : start.arguments) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe failed");
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) become(pointers.data(), start, limits.keeps_permissions);
  // Until exec closes the other end, handlers of this program receive signals.
  ::close(ends[1]);
  char none = 0;
  while (::read(ends[0], &none, 1) < 0 && errno == EINTR) {
  }
  ::close(ends[0]);
}

Process::~Process() {
  if (result_) return;
  send(SIGKILL);
  wait();
}

void Process::send(int signal) const {
  if (!result_) ::kill(pid_, signal);
}

bool Process::is_running() { return !result_ && !collect_if_ended(); }

bool Process::collect_if_ended() {
  int status = 0;
  rusage usage{};
  const bool ended =
      is_copy_ ? has_ended(pid_, status, usage) : ::wait4(pid_, &status, WNOHANG, &usage) == pid_;
  if (ended) collect(status, usage.ru_maxrss);
  return ended;
}

bool Process::catches(int signal) const {
  std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("SigCgt:"))
      return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
  return false;
}

ProcessResult Process::wait() {
  while (is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return *result_;
}

void Process::collect(int status, long peak_kilobytes) {
  ProcessResult result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.output = content(folder_.path() / "output");
  result.errors = content(folder_.path() / "errors");
  result.peak_kilobytes = peak_kilobytes;
  result_ = std::move(result);
}

Words::Words(const std::string& command) {
  std::istringstream stream(command);
  assign(std::istream_iterator<std::string>(stream), {});
}

Words& Words::operator+=(const Words& more) {
  insert(end(), more.begin(), more.end());
  return *this;
}

std::string CommandFolder::content(const std::string& name) const {
  INFO(name);
  REQUIRE(fs::exists(path(name)));
  return remap::content(path(name));
}

Process CommandFolder::start(const Words& words, ProcessLimits limits) const {
  limits.folder = folder_.path();
  return Process(words, limits);
}

ProcessResult run(const Words& arguments, const ProcessLimits& limits) {
  return Process(arguments, limits).wait();
}

}  // namespace remap
