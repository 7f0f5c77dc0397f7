// This file tests which direction of green the names of normal maps state, and copies with inverted green.
#include "texture/normal_green.hpp"

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"

using namespace remap;

TEST_CASE("normal green: names say it by words, and have a name for the other way") {
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"wood_nor_gl_4k.exr", "wood_nor_dx_4k.exr"},
      {"Wood_4K-PNG_NormalGL.png", "Wood_4K-PNG_NormalDX.png"},
      {"x_Normal_OpenGL.png", "x_Normal_DirectX.png"},
      {"x_normal_opengl.1001.png", "x_normal_directx.1001.png"}};
  for (const auto& [up, down] : pairs) {
    CHECK(stated_green(up) == NormalGreen::kUp);
    CHECK(turned_name(up) == down);
  }
  CHECK(stated_green("wood_nor_dx_4k.exr") == NormalGreen::kDown);
  CHECK(turned_name("wood_nor_dx_4k.exr") == "wood_nor_gl_4k.exr");
  for (const std::string silent :
       {"wood_normal.png", "x_glass_normal.png", "angle_nor.png", "dxf_normal.png"})
    CHECK_FALSE(stated_green(silent));
}

TEST_CASE("normal green: an inverted copy differs only in green, for every pixel type") {
  const TemporaryFolder folder;
  const auto type = GENERATE(OIIO::TypeDesc(OIIO::TypeDesc::UINT8), OIIO::TypeDesc(OIIO::TypeDesc::UINT16),
                             OIIO::TypeDesc(OIIO::TypeDesc::HALF));
  const std::string end = type.is_floating_point() ? ".exr" : ".png";
  const auto from = folder.path() / ("nor_gl" + end), to = folder.path() / "made" / ("nor_dx" + end);
  write_image(from, test_spec(70, 130, {"R", "G", "B"}, type), noise);
  const TestImage before = read_image(from);
  {
    const auto copy = turned_copy(std::make_shared<const InputFile>(from), to);
    CHECK_FALSE(std::filesystem::exists(to));
    copy->commit(Flush::kNo);
  }
  const TestImage after = read_image(to);
  REQUIRE(after.values.size() == before.values.size());
  const float step = type == OIIO::TypeDesc(OIIO::TypeDesc::HALF) ? 1e-3f : 1e-6f;
  for (std::size_t i = 0; i < after.values.size(); ++i)
    if (i % 3 == 1)
      REQUIRE(after.values[i] == Approx(1.0f - before.values[i]).margin(step));
    else
      REQUIRE(after.values[i] == before.values[i]);
}

TEST_CASE("normal green: values with a sign change it") {
  const TemporaryFolder folder;
  const auto from = folder.path() / "n.exr", to = folder.path() / "m.exr";
  const auto texel = [](int x, int y, int channel) { return 2.0f * noise(x, y, channel) - 1.0f; };
  write_image(from, test_spec(8, 8, {"R", "G", "B"}, OIIO::TypeFloat), texel);
  turned_copy(std::make_shared<const InputFile>(from), to)->commit(Flush::kNo);
  CHECK(read_image(to).at(3, 5, 1) == -texel(3, 5, 1));
  CHECK(read_image(to).at(3, 5, 2) == texel(3, 5, 2));
}

TEST_CASE("normal green: a map without green cannot be turned, and leaves nothing behind") {
  const TemporaryFolder folder;
  write_image(folder.path() / "n.png", test_spec(8, 8, {"Y"}, OIIO::TypeUInt8), noise);
  CHECK_THROWS_WITH(
      turned_copy(std::make_shared<const InputFile>(folder.path() / "n.png"), folder.path() / "m.png"),
      Catch::Contains("has no green channel to invert"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "m.png"));
}
