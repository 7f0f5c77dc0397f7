// This file handles images in files by an object of Python, for the commands of texremap.
#pragma once

#include <nanobind/nanobind.h>

namespace remap::python {

// From now on `images`, which has the methods of texremap.images.Images, reads and writes images. Without a
// call the first image imports that module.
void use_images(const nanobind::object& images);

}  // namespace remap::python
