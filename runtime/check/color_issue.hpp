// What the values of a color say against the way it is read: rules for `check`, and for `convert` before it
// starts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "remap/pixels.hpp"
#include "sets/naming.hpp"

namespace remap {

struct ColorIssue {
  std::string text;                  // `is 0.19 to 0.26 in 80 % of the texels, like F0 0.04 stored in sRGB`
  std::optional<Transfer> transfer;  // with which the values would be usual
};

// Whether a color map is black or white everywhere, or holds an F0 that only fits the other transfer curve.
// `linear` has rows of red, green and blue, or one of grey, decoded by `transfer`, with factors. None for
// roles other than diffuse, base color and specular, and without texels.
std::optional<ColorIssue> color_issue(Role role, Transfer transfer,
                                      const std::vector<std::vector<float>>& linear);

}  // namespace remap
