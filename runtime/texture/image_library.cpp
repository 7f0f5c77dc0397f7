#include "texture/image_library.hpp"

#include <mutex>
#include <optional>

namespace remap {
namespace {

std::mutex limits_mutex;
std::optional<ImageLimits> wanted_limits;  // unset once the library has the limits

}  // namespace

const ImageLibrary& image_library() {
  static const ImageLibrary& library = load_image_library();
  const std::lock_guard lock(limits_mutex);
  if (wanted_limits) library.set_limits(*wanted_limits);
  wanted_limits.reset();
  return library;
}

void set_image_limits(const ImageLimits& limits) {
  const std::lock_guard lock(limits_mutex);
  wanted_limits = limits;
}

}  // namespace remap
