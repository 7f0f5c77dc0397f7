// This file finds colors whose values contradict how they are read. `check` and `convert` use it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "remap/pixels.hpp"
#include "sets/naming.hpp"

namespace remap {

struct ColorIssue {
  // This text is, for example, `read as linear, is 0.19 to 0.26 in 80 % of the texels, like F0 0.04 stored in
  // sRGB`.
  std::string text;
  std::optional<Transfer> transfer;  // the curve that would make the values plausible
};

// Finds a color map that is black or white everywhere, or whose F0 fits only the other transfer curve.
// `linear` has a row each for red, green and blue, or one row for grey. Its values were decoded by `transfer`
// and multiplied by the factors. Returns nothing for roles other than diffuse, base color and specular, and
// if there are no texels.
std::optional<ColorIssue> color_issue(Role role, Transfer transfer,
                                      const std::vector<std::vector<float>>& linear);

}  // namespace remap
