// This file replaces the image library in a program that is built without it (REMAP_BUILD_IMAGES).
#include "core/errors.hpp"
#include "texture/image_library.hpp"

namespace remap {

const ImageLibrary& load_image_library() {
  throw input_error(
      "this texremap was built without an image library, so it cannot read or write images (use the Python "
      "or the npm package)");
}

}  // namespace remap
