// Converts one material by one generated header, which needs nothing but the standard library:
//   g++ -std=c++17 -I generated examples/convert_material.cpp -o convert_material
#include <cstdio>

#include "mitsuba_ward_to_mitsuba_as.hpp"

int main() {
  namespace ward_to_as = remap::mitsuba_ward_to_mitsuba_as;
  const float alpha = 0.2f;
  const float copper[3] = {0.72f, 0.48f, 0.36f};  // linear red, green, blue

  float as_alpha = 0.0f, f0[3] = {};
  for (int channel = 0; channel < 3; ++channel) {
    const ward_to_as::Output out = ward_to_as::evaluate({alpha, copper[channel]});
    as_alpha = out.alpha;  // the same for every channel
    f0[channel] = out.f0;
  }
  std::printf("%s: alpha %.7g, specular %.7g %.7g %.7g\n", ward_to_as::kSourceModel, double{alpha},
              double{copper[0]}, double{copper[1]}, double{copper[2]});
  std::printf("%s: alpha %.7g, f0 %.7g %.7g %.7g\n", ward_to_as::kTargetModel, double{as_alpha},
              double{f0[0]}, double{f0[1]}, double{f0[2]});
}
