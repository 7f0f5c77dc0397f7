// Checks of compiled warps.
#include <limits>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "remap/warp.hpp"
#include "support/random_warp.hpp"

TEST_CASE("compiled warp: invalid tables are refused") {
  const auto refused = [](const remap::CompiledWarp& warp, const std::string& message) {
    CHECK_THROWS_WITH(remap::require_valid(warp, "leaf"), Catch::Contains("leaf: " + message));
  };
  remap::CompiledWarp warp = remap::random_warp({2, true, true}, 3);
  auto& entries = std::get<remap::CopiedNodes>(warp.table.entries);
  entries.indices[5] = static_cast<std::uint16_t>(entries.palette.size());
  refused(warp, "an index is beyond the end of the palette");
  entries.indices[5] = 0;
  entries.palette[1][3] = std::numeric_limits<float>::quiet_NaN();
  refused(warp, "the palette holds an invalid value");
  entries.palette[1][3] = -0.5f;
  refused(warp, "the palette holds an invalid value");
  entries.palette.clear();
  refused(warp, "the palette has the wrong size (1 to 65536 texels)");
  warp = remap::random_warp({3, true, false}, 3);
  std::get<remap::QuadraticTerms>(warp.coordinates.terms).weights.pop_back();
  refused(warp, "the weights of quadratic terms are invalid (36");
  warp = remap::random_warp({3, false, false}, 3);
  warp.table.nodes = 300;
  refused(warp, "the number of nodes is invalid (2 to 4096 per dimension, at most 2^24");
}
