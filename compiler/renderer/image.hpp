// A linear float image, as renderers give it and the matching reads it.
#pragma once

#include <cstddef>
#include <vector>

namespace remapc {

// Row 0 is the top, column 0 is -x; `channels` values a pixel, interleaved. Linear radiance.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> values;
};

}  // namespace remapc
