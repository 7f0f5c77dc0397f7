#include "support/loaded_program.hpp"

#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/before_cases.hpp"

// This function belongs to the leak sanitizer, if there is one. It ends the process if it finds a leak.
extern "C" {
[[gnu::weak]] void __lsan_do_leak_check();
[[gnu::weak]] void __sanitizer_set_report_fd(void* file);
}

namespace remap {
namespace {

const char* program_path = nullptr;  // null if there is no program
int (*program_main)(int argc, char** argv) = nullptr;
int connection = -1;  // socket to the loaded process
std::mutex one_request;

struct Ended {
  pid_t process = 0;  // 0 as long as it runs
  int status = 0;
  rusage usage{};
};

// Both return true if all bytes were transferred.
bool put(int to, const void* bytes, std::size_t count) {
  for (const char* at = static_cast<const char*>(bytes); count > 0;) {
    const ssize_t sent = ::send(to, at, count, MSG_NOSIGNAL);
    if (sent <= 0) return false;
    at += sent;
    count -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool get(int from, void* bytes, std::size_t count) {
  for (char* at = static_cast<char*>(bytes); count > 0;) {
    const ssize_t received = ::recv(from, at, count, 0);
    if (received <= 0) return false;
    at += received;
    count -= static_cast<std::size_t>(received);
  }
  return true;
}

template <typename Value>
bool put(int to, const Value& value) {
  return put(to, &value, sizeof value);
}
template <typename Value>
bool get(int from, Value& value) {
  return get(from, &value, sizeof value);
}

bool put(int to, const std::string& text) {
  return put(to, text.size()) && put(to, text.data(), text.size());
}
bool get(int from, std::string& text) {
  std::size_t size = 0;
  if (!get(from, size)) return false;
  text.resize(size);
  return get(from, text.data(), size);
}

bool put(int to, const std::vector<std::string>& texts) {
  bool is_sent = put(to, texts.size());
  for (const std::string& text : texts) is_sent = is_sent && put(to, text);
  return is_sent;
}
bool get(int from, std::vector<std::string>& texts) {
  std::size_t count = 0;
  bool is_received = get(from, count);
  texts.resize(count);
  for (std::string& text : texts) is_received = is_received && get(from, text);
  return is_received;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

[[noreturn]] void become(ProcessStart start, std::vector<std::string> environment) {
  ::close(connection);
  const int errors_of_test = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  enter(start);
  std::vector<char*> variables = pointers(environment), arguments = pointers(start.arguments);
  environ = variables.data();
  const int code = program_main(static_cast<int>(start.arguments.size()), arguments.data());
  std::cout.flush();
  std::fflush(nullptr);
  if (&__lsan_do_leak_check != nullptr) {
    __sanitizer_set_report_fd(reinterpret_cast<void*>(static_cast<std::intptr_t>(errors_of_test)));
    __lsan_do_leak_check();
  }
  // Do not call exit(): a library of OpenImageIO would wait there for its thread, which a copy does not have.
  ::_exit(code);
}

// Runs the loaded process, which starts copies of itself until the test program has ended.
[[noreturn]] void serve() {
  for (char request = 0; get(connection, request);) {
    if (request == 's') {
      ProcessStart start;
      std::vector<std::string> environment;
      if (!get(connection, start.arguments) || !get(connection, start.folder) ||
          !get(connection, start.output) || !get(connection, start.errors) ||
          !get(connection, start.file_bytes) || !get(connection, environment))
        break;
      const pid_t process = ::fork();
      if (process == 0) become(std::move(start), std::move(environment));
      put(connection, process);
    } else {
      Ended ended;
      pid_t process = 0;
      if (!get(connection, process)) break;
      ended.process = ::wait4(process, &ended.status, WNOHANG, &ended.usage);
      put(connection, ended);
    }
  }
  ::_exit(0);
}

void load() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::runtime_error("socketpair failed");
  const pid_t loaded = ::fork();
  if (loaded < 0) throw std::runtime_error("fork failed");
  connection = ends[loaded == 0 ? 1 : 0];
  ::close(ends[loaded == 0 ? 0 : 1]);
  if (loaded == 0) serve();
}

[[noreturn]] void fail() { throw std::runtime_error("the loaded program is gone"); }

}  // namespace

void enter(const ProcessStart& start) noexcept {
  constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
  ::dup2(::open(start.output.c_str(), kNew, 0600), STDOUT_FILENO);
  ::dup2(::open(start.errors.c_str(), kNew, 0600), STDERR_FILENO);
  const rlimit limit{start.file_bytes, start.file_bytes};
  if (start.file_bytes != RLIM_INFINITY) ::setrlimit(RLIMIT_FSIZE, &limit);
  if (!start.folder.empty() && ::chdir(start.folder.c_str()) != 0) ::_exit(126);
}

bool loads_program(const char* path, int (*main)(int argc, char** argv)) {
  program_path = path;
  program_main = main;
  before_cases(load);
  return true;
}

bool is_loaded(const std::string& path) { return program_path != nullptr && path == program_path; }

pid_t start_loaded(const ProcessStart& start) {
  const std::lock_guard lock(one_request);
  std::vector<std::string> environment;
  for (char** variable = environ; *variable != nullptr; ++variable) environment.emplace_back(*variable);
  pid_t process = 0;
  if (!put(connection, 's') || !put(connection, start.arguments) || !put(connection, start.folder) ||
      !put(connection, start.output) || !put(connection, start.errors) ||
      !put(connection, start.file_bytes) || !put(connection, environment) || !get(connection, process))
    fail();
  if (process < 0) throw std::runtime_error("fork failed");
  return process;
}

bool has_ended(pid_t process, int& status, rusage& usage) {
  const std::lock_guard lock(one_request);
  Ended ended;
  if (!put(connection, 'w') || !put(connection, process) || !get(connection, ended)) fail();
  status = ended.status;
  usage = ended.usage;
  return ended.process == process;
}

}  // namespace remap
