// This file tests that the image module is loaded, and that its exceptions reach the program.
#include "texture/image_library.hpp"

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;

TEST_CASE("image library: it can be loaded, and the program can catch its errors") {
  CHECK(&image_library() == &image_library());
  const TemporaryFolder folder;
  const auto text = folder.path() / "text.png";
  write_file(text, "no image");
  try {
    (void)image_library().open(text, 0);
    FAIL("text was opened as an image");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::kInput);
    CHECK_THAT(error.what(), Catch::Matchers::Contains("text.png: cannot be read as an image"));
  }
}
