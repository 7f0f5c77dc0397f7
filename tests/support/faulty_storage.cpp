// This library is preloaded (LD_PRELOAD) over functions that open files. The first FAULT_COUNT opens of names
// that contain FAULT_NAME fail with the errno FAULT_CODE, like storage that does not answer for a while. With
// FAULT_SIGNAL they end the process by that signal instead, like an importer that reads beyond its memory.
// The file OPENS_LOG lists the names of all opened files.
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>

namespace {

using OpenStream = std::FILE* (*)(const char*, const char*);
using OpenFile = int (*)(const char*, int, ...);
using OpenFileAt = int (*)(int, const char*, int, ...);

template <typename Function>
Function next(const char* symbol) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, symbol));
}

void note(const char* path) {
  static const OpenStream open = next<OpenStream>("fopen");
  const char* const log = std::getenv("OPENS_LOG");
  std::FILE* const file = log != nullptr ? open(log, "ae") : nullptr;
  if (file == nullptr) return;
  std::fprintf(file, "%s\n", path);
  std::fclose(file);
}

bool fails(const char* path) {
  static std::atomic<int> faults = 0;
  note(path);
  const char *name = std::getenv("FAULT_NAME"), *count = std::getenv("FAULT_COUNT"),
             *code = std::getenv("FAULT_CODE"), *signal = std::getenv("FAULT_SIGNAL");
  if (name != nullptr && signal != nullptr && std::strstr(path, name) != nullptr)
    std::raise(std::atoi(signal));
  if (name == nullptr || count == nullptr || code == nullptr || std::strstr(path, name) == nullptr)
    return false;
  if (faults++ >= std::atoi(count)) return false;
  errno = std::atoi(code);
  return true;
}

std::FILE* next_fopen(const char* symbol, const char* path, const char* mode) {
  return fails(path) ? nullptr : next<OpenStream>(symbol)(path, mode);
}

// Returns the permissions of a new file, which follow the flags.
unsigned mode_in(int flags, std::va_list arguments) {
  return (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(arguments, unsigned) : 0;
}

}  // namespace

extern "C" std::FILE* fopen(const char* path, const char* mode) { return next_fopen("fopen", path, mode); }
extern "C" std::FILE* fopen64(const char* path, const char* mode) {
  return next_fopen("fopen64", path, mode);
}

extern "C" int open(const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const unsigned mode = mode_in(flags, arguments);
  va_end(arguments);
  return fails(path) ? -1 : next<OpenFile>("open")(path, flags, mode);
}
extern "C" int open64(const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const unsigned mode = mode_in(flags, arguments);
  va_end(arguments);
  return fails(path) ? -1 : next<OpenFile>("open64")(path, flags, mode);
}
extern "C" int openat(int folder, const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const unsigned mode = mode_in(flags, arguments);
  va_end(arguments);
  return fails(path) ? -1 : next<OpenFileAt>("openat")(folder, path, flags, mode);
}
extern "C" int openat64(int folder, const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const unsigned mode = mode_in(flags, arguments);
  va_end(arguments);
  return fails(path) ? -1 : next<OpenFileAt>("openat64")(folder, path, flags, mode);
}
