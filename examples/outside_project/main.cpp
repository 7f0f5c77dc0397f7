// This program converts a row of texels (roughness and RGB specular) by the batch function of a generated
// header.
#include <array>
#include <cstdio>
#include <remap/mitsuba_ward_to_mitsuba_as.hpp>

int main() {
  using ward_to_as = remap::mitsuba_ward_to_mitsuba_as;
  if (!ward_to_as::self_test()) return 1;

  constexpr std::size_t kCount = 4;
  std::array<float, kCount> alpha = {0.05f, 0.2f, 0.4f, 0.8f};
  std::array<float, kCount> red = {0.7f, 0.7f, 0.7f, 0.7f}, green = {0.5f, 0.5f, 0.5f, 0.5f}, blue = {};
  // The conversion is in place: each output row is its input row.
  const std::size_t outside =
      ward_to_as::evaluate_batch(kCount, {alpha.data(), {red.data(), green.data(), blue.data()}},
                                 {alpha.data(), {red.data(), green.data(), blue.data()}});
  for (std::size_t i = 0; i < kCount; ++i)
    std::printf("alpha %.7g, f0 %.7g %.7g %.7g\n", double{alpha[i]}, double{red[i]}, double{green[i]},
                double{blue[i]});
  std::printf("%zu texels out of domain\n", outside);
}
