#include "texture/image_library.hpp"

#include <mutex>
#include <optional>
#include <utility>

namespace remap {
namespace {

std::mutex limits_mutex;
std::optional<std::pair<int, std::uint64_t>> wanted_limits;  // unset after the library has got the limits

}  // namespace

const ImageLibrary& image_library() {
  static const ImageLibrary& library = load_image_library();
  const std::lock_guard lock(limits_mutex);
  if (wanted_limits) library.set_limits(wanted_limits->first, wanted_limits->second);
  wanted_limits.reset();
  return library;
}

void set_image_limits(int threads, std::uint64_t memory_bytes) {
  const std::lock_guard lock(limits_mutex);
  wanted_limits = {threads, memory_bytes};
}

}  // namespace remap
