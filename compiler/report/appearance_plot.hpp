// Draws appearance spaces as clouds of points.
#pragma once

#include <vector>

#include "report/shaded_map.hpp"
#include "warp/space/coordinates.hpp"

namespace remapc {

// Points of one kind. Later points cover earlier ones.
struct PlottedPoints {
  Points positions;                  // the first two coordinates are drawn; rows with NaN are skipped
  std::vector<DisplayColor> colors;  // one per point, or one for all
  double radius = 1.0;               // in pixels
};

// The visible part of the plane.
struct PlotBox {
  double x = 0.0, y = 0.0;  // centre
  double half_width = 1.0, half_height = 1.0;
};

// The bounding box of all layers, enlarged by a twentieth, and widened to an aspect ratio of 1:1 to 3:1.
PlotBox box_around(const std::vector<PlottedPoints>& layers);

// Draws the layers `width` pixels wide, with the aspect ratio of the box. The second coordinate points up;
// one-dimensional points are spread along it to be visible. Lines mark the zeros.
Image appearance_plot(const std::vector<PlottedPoints>& layers, const PlotBox& box, int width);

}  // namespace remapc
