// A library to preload (LD_PRELOAD) that lets the first FAULT_COUNT calls of fopen for names that contain
// FAULT_NAME fail with the errno FAULT_CODE: storage that does not answer for a while.
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>

namespace {

bool fails(const char* path) {
  static std::atomic<int> faults = 0;
  const char *name = std::getenv("FAULT_NAME"), *count = std::getenv("FAULT_COUNT"),
             *code = std::getenv("FAULT_CODE");
  if (name == nullptr || count == nullptr || code == nullptr || std::strstr(path, name) == nullptr)
    return false;
  if (faults++ >= std::atoi(count)) return false;
  errno = std::atoi(code);
  return true;
}

std::FILE* next_fopen(const char* symbol, const char* path, const char* mode) {
  using Open = std::FILE* (*)(const char*, const char*);
  static const auto open = reinterpret_cast<Open>(::dlsym(RTLD_NEXT, symbol));
  return fails(path) ? nullptr : open(path, mode);
}

}  // namespace

extern "C" std::FILE* fopen(const char* path, const char* mode) { return next_fopen("fopen", path, mode); }
extern "C" std::FILE* fopen64(const char* path, const char* mode) {
  return next_fopen("fopen64", path, mode);
}
