// This file tests pictures of maps: their grid, and what a pixel shows.
#include <algorithm>

#include <catch2/catch.hpp>

#include "report/warp_report.hpp"

using namespace remap;

TEST_CASE("pictures of maps: sizes, and what a pixel shows") {
  const PictureGrid small = picture_grid(4, 2, 8);
  CHECK(small.width == 8);
  CHECK(small.height == 4);
  CHECK(small.samples == 1);
  CHECK(small.texels[0] == small.texels[1]);  // texels are repeated
  const PictureGrid large = picture_grid(4096, 1024, 512);
  CHECK(large.width == 512);
  CHECK(large.height == 128);
  CHECK(large.texels.size() == 9 * 512 * 128);
  CHECK(*std::max_element(large.texels.begin(), large.texels.end()) < 4096u * 1024u);
  // A white diffuse map is brightest where it faces the key light, and stays grey.
  const PictureGrid grid = picture_grid(16, 16, 16);
  const WarpTexel white = {1, 1, 1, 0, 0, 0, 0.5f};
  const Image lit = shaded_map(grid, std::vector<WarpTexel>(256, white), {Brdf::kGgx, Fresnel::kNone});
  CHECK(lit.values[0] == lit.values[2]);
  CHECK(lit.values[0] > lit.values[3 * 255]);
  CHECK(lit.values[0] > 0.9f);
}
