// This program converts one material by a generated header, which needs only the standard library:
//   g++ -std=c++17 -I generated examples/convert_material.cpp -o convert_material
#include <cstdio>

#include "mitsuba_ward_to_mitsuba_as.hpp"

int main() {
  using ward_to_as = remap::mitsuba_ward_to_mitsuba_as;
  const ward_to_as::Texel<3> copper{0.2f, {0.72f, 0.48f, 0.36f}};  // alpha; linear red, green, blue

  const auto as = ward_to_as::evaluate(copper);
  std::printf("%s: alpha %.7g, specular %.7g %.7g %.7g\n", ward_to_as::kSourceModel, double{copper.width},
              double{copper.specular[0]}, double{copper.specular[1]}, double{copper.specular[2]});
  std::printf("%s: alpha %.7g, f0 %.7g %.7g %.7g\n", ward_to_as::kTargetModel, double{as.width},
              double{as.specular[0]}, double{as.specular[1]}, double{as.specular[2]});
}
