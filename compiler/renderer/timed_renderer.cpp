#include "renderer/timed_renderer.hpp"

#include "core/stopwatch.hpp"

namespace remap {

Image TimedRenderer::render(const Material& material, const Scene& scene) const {
  const Stopwatch stopwatch;
  Image image = inner_.render(material, scene);
  seconds_ += stopwatch.seconds();
  ++pictures_;
  return image;
}

}  // namespace remap
