#include <array>
#include <cerrno>
#include <csignal>
#include <sys/resource.h>
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

fs::path program_file() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored);
}

ResourceUse resource_use() noexcept {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return {};
  constexpr std::size_t kUnit = 1024;  // Linux counts in kilobytes
  return {seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime),
          static_cast<std::size_t>(usage.ru_maxrss) * kUnit};
}

}  // namespace remap
