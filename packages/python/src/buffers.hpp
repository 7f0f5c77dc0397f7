// This file turns arrays of Python into channels of maps, without copies.
#pragma once

#include <cstddef>
#include <memory>
#include <nanobind/nanobind.h>
#include <string>
#include <vector>

#include "remap/pixels.hpp"

namespace remap::python {

// A Buffer is the memory of an object with the buffer protocol, held until the last copy is gone. Make and
// destroy it with the interpreter lock.
class Buffer {
 public:
  enum class Access { kRead, kWrite };

  // Throws kUsage, beginning with `name`, for an object without the protocol and for one that must be
  // writable but is not. Also throws it for values that are not numbers of 8 to 64 bits in the order of this
  // machine.
  Buffer(nanobind::handle object, Access access, const std::string& name);

  std::size_t dimensions() const noexcept { return static_cast<std::size_t>(view_->ndim); }
  std::size_t extent(std::size_t axis) const noexcept { return static_cast<std::size_t>(view_->shape[axis]); }
  PixelType type() const noexcept { return type_; }

  // Returns the channels of (height, width, channels).
  std::vector<ChannelView> channels() const;
  std::vector<ConstChannelView> const_channels() const;

 private:
  std::shared_ptr<Py_buffer> view_;
  PixelType type_ = PixelType::kFloat;
};

}  // namespace remap::python
