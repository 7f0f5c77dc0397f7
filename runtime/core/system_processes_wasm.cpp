// WebAssembly has no processes. The host reports the process, the machine and the use of resources
// (packages/npm/cli.js). A web page reports nothing.
#include <array>
#include <cstdlib>
#include <emscripten.h>

#include "core/system.hpp"

namespace remap {
namespace {

// clang-format off
EM_JS(int, remap_host_process, (), { return Module["processes"] ? Module["processes"].own : 1; });
EM_JS(int, remap_host_has_ended, (int process), { return Module["processes"] ? Module["processes"].hasEnded(process) : 0; });
EM_JS(char*, remap_host_machine, (), { return allocateUTF8(Module["processes"] ? Module["processes"].machine : ""); });
EM_JS(void, remap_host_use, (double* use), { if (Module["processes"]) HEAPF64.set(Module["processes"].use(), use >> 3); });
// clang-format on

}  // namespace

int own_process() { return remap_host_process(); }

bool has_ended(int process) { return remap_host_has_ended(process) != 0; }

std::string machine_name() {
  char* const name = remap_host_machine();
  const std::string text = name;
  std::free(name);
  return text;
}

// Returns 4 GB, because WebAssembly with 32-bit addresses cannot use more, whatever the machine has.
std::uint64_t memory_size() { return std::uint64_t{4} << 30; }

std::filesystem::path program_file() { return {}; }

// WebAssembly makes no copies of processes.
std::optional<ProcessCopy> copy_process(const std::function<void(int)>&) { return std::nullopt; }
std::string end_of(const ProcessCopy&) { return ""; }
void interrupt(const ProcessCopy&) {}
bool send_all(int, const std::string&) { return false; }
std::vector<bool> wait_to_read(const std::vector<int>&) { return {}; }

// The units are seconds and bytes.
ResourceUse resource_use() noexcept {
  std::array<double, 2> use{};
  remap_host_use(use.data());
  return {use[0], static_cast<std::size_t>(use[1])};
}

}  // namespace remap
