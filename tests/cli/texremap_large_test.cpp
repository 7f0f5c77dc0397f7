// This file tests maps that are larger than the memory that texremap may use. It is slow; `texremap_test
// "[large]"` runs it. A full campaign has maps of four times the size.
#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "support/campaign.hpp"

using namespace remap;

namespace {

constexpr int kBand = 64;

// texremap needs 170 MB for any size. Half of the maps as floats would exceed the limit.
long most_megabytes() { return is_full_campaign() ? 300 : 220; }

// Writes noise band by band.
void write_large(const std::string& path, const std::vector<std::string>& channels, int size) {
  OIIO::ImageSpec spec = test_spec(size, size, channels, OIIO::TypeHalf);
  spec.attribute("Compression", "zip");
  const auto output = OIIO::ImageOutput::create(path);
  REQUIRE(output->open(path, spec));
  const auto row = static_cast<std::size_t>(size) * channels.size();
  std::vector<float> grain(kBand * row), band(grain.size());
  for (int y = 0; y < kBand; ++y)
    for (int x = 0; x < size; ++x)
      for (int c = 0; c < spec.nchannels; ++c)
        grain[static_cast<std::size_t>((y * size + x) * spec.nchannels + c)] = 0.1f * noise(x, y, c);
  for (int top = 0; top < size; top += kBand) {
    for (std::size_t i = 0; i < band.size(); ++i) {  // smooth as in a texture, with added noise
      const auto x = static_cast<float>(i % row / channels.size()), y = static_cast<float>(i / row);
      band[i] =
          (x + 2.0f * (static_cast<float>(top) + y)) / (3.0f * static_cast<float>(size)) * 0.9f + grain[i];
    }
    REQUIRE(output->write_scanlines(top, top + kBand, 0, OIIO::TypeFloat, band.data()));
  }
  REQUIRE(output->close());
}

class BandReader {
 public:
  explicit BandReader(const std::string& path) : input_(OIIO::ImageInput::open(path)) {
    REQUIRE(input_);
    band_.resize(static_cast<std::size_t>(kBand * input_->spec().width * input_->spec().nchannels));
  }
  const std::vector<float>& read(int top) {
    REQUIRE(input_->read_scanlines(0, 0, top, top + kBand, 0, 0, input_->spec().nchannels, OIIO::TypeFloat,
                                   band_.data()));
    return band_;
  }

 private:
  std::unique_ptr<OIIO::ImageInput> input_;
  std::vector<float> band_;
};

}  // namespace

TEST_CASE("texremap: large maps in bounded memory, equal to the converter texel by texel", "[.][large]") {
  // As floats, inputs and results take 512 MB, and 2 GB in a full campaign.
  const int size = is_full_campaign() ? 8192 : 4096;
  const Session session;
  write_large(session.path("r.exr"), {"Y"}, size);
  write_large(session.path("s.exr"), {"R", "G", "B"}, size);
  const ProcessResult result = require_success(session.convert("r.exr", "s.exr"));
  WARN(result.errors << result.peak_kilobytes / 1024 << " MB at most");
  CHECK(result.peak_kilobytes < most_megabytes() * 1024);

  BandReader roughness(session.path("r.exr")), specular(session.path("s.exr"));
  BandReader roughness_out(session.path("out/r.exr")), specular_out(session.path("out/s.exr"));
  const Converter& converter = find_converter("mitsuba/ward", "mitsuba/as");
  std::size_t different = 0;
  for (int top = 0; top < size; top += kBand) {
    const auto &r = roughness.read(top), &s = specular.read(top), &r_out = roughness_out.read(top),
               &s_out = specular_out.read(top);
    std::array<std::vector<float>, 4> expected;
    for (std::size_t c = 0; c < 4; ++c) expected[c].resize(r.size());
    for (std::size_t i = 0; i < 3 * r.size(); ++i) expected[1 + i % 3][i / 3] = s[i];
    const std::array<const float*, 3> in = {expected[1].data(), expected[2].data(), expected[3].data()};
    const std::array<float*, 3> out = {expected[1].data(), expected[2].data(), expected[3].data()};
    converter.convert(r.size(), r.data(), in, expected[0].data(), out);
    for (std::size_t i = 0; i < r.size(); ++i)
      different += r_out[i] != as_stored(expected[0][i], OIIO::TypeHalf);
    for (std::size_t i = 0; i < 3 * r.size(); ++i)
      different += s_out[i] != as_stored(expected[1 + i % 3][i / 3], OIIO::TypeHalf);
  }
  CHECK(different == 0);
}
