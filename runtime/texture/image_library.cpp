#include "texture/image_library.hpp"

#include <atomic>

namespace remap {
namespace {

std::atomic<int> wanted_threads = 0;  // 0 once the library knows them

}  // namespace

const ImageLibrary& image_library() {
  static const ImageLibrary& library = load_image_library();
  if (const int count = wanted_threads.exchange(0); count > 0) library.set_thread_count(count);
  return library;
}

void set_image_thread_count(int count) { wanted_threads = count; }

}  // namespace remap
