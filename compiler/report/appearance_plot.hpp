// Appearance spaces as clouds of points.
#pragma once

#include <vector>

#include "report/shaded_map.hpp"
#include "warp/space/coordinates.hpp"

namespace remapc {

// Points of one kind; later ones lie above earlier ones.
struct PlottedPoints {
  Points positions;                  // the first two coordinates are shown; rows that are NaN are not
  std::vector<DisplayColor> colors;  // one each, or one for all
  double radius = 1.0;               // pixels
};

// A part of the plane.
struct PlotBox {
  double x = 0.0, y = 0.0;  // centre
  double half_width = 1.0, half_height = 1.0;
};

// The least one around all layers, a twentieth larger; widened where it is higher than wide or flatter than
// one to three.
PlotBox box_around(const std::vector<PlottedPoints>& layers);

// `width` pixels wide, as high as the box asks for, both axes to one scale. The second coordinate points up;
// of one-dimensional points it is spread evenly, for eyes only. Lines mark the zeros.
Image appearance_plot(const std::vector<PlottedPoints>& layers, const PlotBox& box, int width);

}  // namespace remapc
