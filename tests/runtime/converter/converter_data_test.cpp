// This file tests the data of lowered fits, which the emitter writes and texremap reads.
#include "converter/converter_data.hpp"

#include <catch2/catch.hpp>

#include "emit/emit.hpp"
#include "lower/fit_file.hpp"
#include "lower/lower.hpp"
#include "remap/error.hpp"

using namespace remap;

namespace {

Fit shipped_fit() {
  return load_fit(std::string(REMAP_SOURCE_DIR) + "/fits/mitsuba_ward_duer_to_mitsuba_phong.json");
}

}  // namespace

TEST_CASE("converter data: reads back exactly, in the order of their ids") {
  const Fit fit = shipped_fit();
  Fit other = fit;
  other.converter->info.id = "a_to_b";
  other.converter->info.image_rms_error = std::nullopt;
  other.converter->info.ssim = std::nullopt;
  const std::string text = emit_shared_files({fit, other})[0].text;
  CHECK(text == emit_shared_files({other, fit})[0].text);
  CHECK(converters_from_json(text, "list") == std::vector<ConverterData>{*other.converter, *fit.converter});
}

TEST_CASE("converter data: the SSIM is the mean of the fit's spheres, in three digits") {
  Fit fit = shipped_fit();
  const auto ssim = [&] {
    add_converter(&fit);
    return fit.converter->info.ssim;
  };
  fit.ssim = {{0.1, 0.5}, {0.5, 0.75}, {0.9, 0.751}};
  CHECK(ssim() == 0.667);
  fit.ssim.clear();
  CHECK_FALSE(ssim().has_value());
}

TEST_CASE("converter data: a damaged file is refused with the place") {
  const std::string text = emit_shared_files({shipped_fit()})[0].text;
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& place) {
    std::string damaged = text;
    REQUIRE(damaged.find(from) != std::string::npos);
    damaged.replace(damaged.find(from), from.size(), to);
    CHECK_THROWS_WITH(converters_from_json(damaged, "list"), Catch::StartsWith("list: " + place));
  };
  refused("\"version\": 2", "\"version\": 3", "version");
  refused("\"ssim\": 0", "\"ssim\": \"0\", \"of\": 0", "converters[0].ssim");
  refused("\"pole\": ", "\"pole\": -", "converters[0].pole");
  refused("\"turn\":", "\"turned\":", "converters[0].hinge");
  refused("\"roughness\":\"exponent\"", "\"roughness\":\"width\"", "converters[0].target.roughness");
}
