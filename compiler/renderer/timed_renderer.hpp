// This file counts the pictures of a renderer and the time that they take.
#pragma once

#include <atomic>

#include "renderer/renderer.hpp"

namespace remap {

// A TimedRenderer renders like `inner`. Its seconds are the time that callers waited, summed over threads.
class TimedRenderer final : public Renderer {
 public:
  explicit TimedRenderer(const Renderer& inner) : inner_(inner) {}

  std::size_t picture_count() const { return pictures_; }
  double seconds() const { return seconds_; }

  std::string version() const override { return inner_.version(); }
  std::string version_of(const std::string& model) const override { return inner_.version_of(model); }
  std::vector<ModelDescription> models() const override { return inner_.models(); }
  ModelDescription model(const std::string& name) const override { return inner_.model(name); }
  Image render(const Material& material, const Scene& scene) const override;

 private:
  const Renderer& inner_;
  mutable std::atomic<std::size_t> pictures_ = 0;
  mutable std::atomic<double> seconds_ = 0.0;
};

}  // namespace remap
