// This program converts interleaved RGBA texels by a header of BRDFs. Red, green and blue are specular, and
// alpha is the width. The texels are floats, or integers of 8 bits.
//   g++ -std=c++17 -O2 -I generated examples/convert_texels.cpp -o convert_texels
#include <cstdio>

#include "cycles_5_ggx_to_mitsuba_ggx.hpp"
#include "mitsuba_ward_to_mitsuba_as.hpp"

namespace {

// A Byte stores 0 to 1 as an integer from 0 to 255. A type of half floats needs the same two conversions.
class Byte {
 public:
  explicit Byte(float value)
      : code_(static_cast<unsigned char>(value < 1.0f ? value * 255.0f + 0.5f : 255.0f)) {}
  explicit operator float() const { return static_cast<float>(code_) / 255.0f; }

 private:
  unsigned char code_;
};

template <class Converter, class T, std::size_t Count>
void convert(T (&rgba)[Count]) {
  const std::size_t outside = Converter::template evaluate_batch<3, T>(
      Count / 4, {rgba + 3, {rgba, rgba + 1, rgba + 2}, 4, 4}, {rgba + 3, {rgba, rgba + 1, rgba + 2}, 4, 4});
  std::printf("%s: %s %.3f, %s %.3f %.3f %.3f; %zu out of domain\n", Converter::kTargetModel,
              Converter::kTargetWidth, double{static_cast<float>(rgba[3])}, Converter::kTargetSpecular,
              double{static_cast<float>(rgba[0])}, double{static_cast<float>(rgba[1])},
              double{static_cast<float>(rgba[2])}, outside);
}

}  // namespace

int main() {
  float texels[] = {0.72f, 0.48f, 0.36f, 0.2f, 0.5f, 0.5f, 0.5f, 0.4f};
  Byte bytes[] = {Byte(0.72f), Byte(0.48f), Byte(0.36f), Byte(0.2f)};
  convert<remap::mitsuba_ward_to_mitsuba_as>(texels);
  convert<remap::cycles_5_ggx_to_mitsuba_ggx>(bytes);
}
