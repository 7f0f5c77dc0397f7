// This file tests texts of bytes and of UTF-16, and MTL and OBJ files in both encodings.
#include <random>

#include <catch2/catch.hpp>

#include "assets/document/text_edits.hpp"
#include "assets/obj/obj_mesh.hpp"
#include "core/errors.hpp"
#include "runtime/assets/mtl_texts.hpp"

using namespace remap;

namespace {

const std::string kMark = "\xef\xbb\xbf";

std::string decoded(const std::string& bytes) { return utf8_text(MemorySource(bytes), "file"); }

std::string decoding_refusal(const std::string& bytes) {
  try {
    (void)decoded(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Returns a text of letters, of characters of two to four bytes, and of line endings.
std::string random_text(std::mt19937& random, std::size_t length) {
  std::string text;
  for (std::size_t i = 0; i < length; ++i) {
    const std::uint32_t most = random() % 2 == 0 ? 0x7f : random() % 2 == 0 ? 0x7ff : 0x10ffff;
    const auto code = static_cast<std::uint32_t>(random() % (most + 1));
    if (code < 0xd800 || code > 0xdfff) text += utf8_of(code);
  }
  return text;
}

}  // namespace

TEST_CASE("UTF-16 becomes UTF-8 and the same bytes again", "[assets]") {
  CHECK(decoded(std::string("\xff\xfen\0\xe9\0", 6)) == kMark + "n\xc3\xa9");
  CHECK(decoded(std::string("\xfe\xff\0n\xd8\x3d\xde\x00", 8)) == kMark + "n\xf0\x9f\x98\x80");
  CHECK(decoded(std::string("n\0e\0w\0", 6)) == "new");
  CHECK(decoded(std::string("\0n\0e", 4)) == "ne");
  CHECK(decoded("caf\xe9\n") == "caf\xe9\n");
  CHECK(decoded("").empty());
  std::mt19937 random(5);
  for (const TextEncoding encoding : {TextEncoding::kUtf16Little, TextEncoding::kUtf16Big})
    for (int i = 0; i < 300; ++i) {
      const std::string text = kMark + random_text(random, random() % 40);
      const std::string bytes = encoded(text, encoding, "file");
      REQUIRE(encoding_of(MemorySource(bytes)) == encoding);
      REQUIRE(decoded(bytes) == text);
    }
  // Some characters lie on the edges of blocks.
  const std::string text = kMark + "x" + random_text(random, std::size_t{1} << 20);
  CHECK(decoded(encoded(text, TextEncoding::kUtf16Big, "file")) == text);
}

TEST_CASE("Half a character of UTF-16 is refused with its place", "[assets]") {
  const auto refusal = [](int byte) {
    return "file: has an incomplete UTF-16 character at byte " + std::to_string(byte) + " (save it as UTF-8)";
  };
  CHECK(decoding_refusal(std::string("\xff\xfen\0x", 5)) == refusal(4));
  CHECK(decoding_refusal(std::string("\xfe\xff\0n\xd8\x3d\0n", 8)) == refusal(4));
  CHECK(decoding_refusal(std::string("\xfe\xff\0n\xd8\x3d", 6)) == refusal(4));
  CHECK(decoding_refusal(std::string("\xfe\xff\0n\xde\x00\0n", 8)) == refusal(4));
  CHECK(decoding_refusal(std::string("\xfe\xff\xd8\x3d\xd8\x3d\xde\x00", 8)) == refusal(2));
  const std::string edge =
      "\xff\xfe" + std::string((std::size_t{1} << 20) - 4, 'x') + std::string("\x3d\xd8x\0", 4);
  CHECK(decoding_refusal(edge) == refusal((1 << 20) - 2));
  CHECK_THROWS_WITH(encoded("caf\xe9", TextEncoding::kUtf16Big, "file"),
                    "file: refers to a file whose name UTF-16 cannot store (rename the file)");
}

TEST_CASE("An MTL file of UTF-16 is edited as one of UTF-8", "[assets]") {
  const std::string text = kMark +
                           "# \xe6\x9d\xb1\xe4\xba\xac\r\nnewmtl caf\xc3\xa9\r\n\tKd .5 .5 .50\r\nKs 1 1 "
                           "1\r\nNs 30\r\nfoo \xf0\x9f\x98\x80";
  const AssetConversion plain = converted_mtl(text);
  REQUIRE(plain.pieces.size() == 1);
  for (const TextEncoding encoding : {TextEncoding::kUtf16Little, TextEncoding::kUtf16Big}) {
    const AssetConversion wide = converted_mtl(encoded(text, encoding, "file"));
    CHECK(wide.materials.at(0).name == "caf\xc3\xa9");
    REQUIRE(wide.pieces.size() == 1);
    CHECK(wide.pieces[0].bytes == encoded(plain.pieces[0].bytes, encoding, "file"));
    CHECK_FALSE(converted_mtl(wide.pieces[0].bytes).changed);
  }
}

TEST_CASE("An OBJ file of UTF-16 is read as one of UTF-8", "[assets]") {
  const std::string text =
      kMark + "mtllib caf\xc3\xa9.mtl\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\no caf\xc3\xa9\r\nf 1 2 3";
  for (const TextEncoding encoding : {TextEncoding::kUtf16Little, TextEncoding::kUtf16Big}) {
    const std::string bytes = encoded(text, encoding, "file");
    const ObjScene scene = read_obj(MemorySource(bytes), "file");
    CHECK(scene.libraries == std::vector<std::string>{"caf\xc3\xa9.mtl"});
    CHECK(obj_libraries(MemorySource(bytes), "file") == scene.libraries);
    REQUIRE(scene.shapes.size() == 1);
    CHECK(scene.shapes[0].name == "caf\xc3\xa9");
    CHECK(scene.shapes[0].primitives.at(0).vertex_count() == 3);
  }
}
