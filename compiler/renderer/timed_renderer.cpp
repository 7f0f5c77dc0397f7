#include "renderer/timed_renderer.hpp"

#include <chrono>

namespace remap {

Image TimedRenderer::render(const Material& material, const Scene& scene) const {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Image image = inner_.render(material, scene);
  nanoseconds_ += std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
  ++pictures_;
  return image;
}

}  // namespace remap
