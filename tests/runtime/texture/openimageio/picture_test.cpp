// This file tests whole pictures that are written and read back.
#include <map>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/temporary_folder.hpp"
#include "texture/image_library.hpp"

using namespace remap;

namespace {

const Picture kPicture = {
    2, 2, {"R", "G", "B"}, {0.0f, 0.25f, 1.0f, 1e-9f, -2.0f, 3e9f, 0.5f, 0.1f, 0.2f, 0.3f, 0.4f, 0.6f}};

}  // namespace

TEST_CASE("pictures: an EXR holds every float, its channels and its attributes") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "new folder" / "p.exr";
  image_library().write_exr(path, kPicture, {{"remap:note", "a note"}});
  const Picture read = image_library().read_picture(path);
  CHECK(read.width == 2);
  CHECK(read.height == 2);
  CHECK(read.channels == kPicture.channels);
  CHECK(read.values == kPicture.values);
  CHECK(image_library().open(path, 0)->noted_metadata("remap:note") == "a note");
}

TEST_CASE("pictures: a PNG holds 8 bits, in a file and in memory") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "p.png";
  image_library().write_png(path, kPicture);
  CHECK(read_file(path) == image_library().png_bytes(kPicture));
  CHECK(image_library().read_picture(path).values.at(1) == 64.0f / 255.0f);
}

TEST_CASE("pictures: a failure names the file") {
  const TemporaryFolder folder;
  write_file(folder.path() / "file", "");
  CHECK_THROWS_AS(image_library().write_exr(folder.path() / "file" / "p.exr", kPicture, {}), Error);
}
