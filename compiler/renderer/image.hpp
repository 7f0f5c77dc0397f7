// A linear float image: the result of a renderer and the input of the match.
#pragma once

#include <cstddef>
#include <vector>

namespace remapc {

// Linear radiance, `channels` interleaved values a pixel. Row 0 is at the top, column 0 at -x.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> values;
};

}  // namespace remapc
