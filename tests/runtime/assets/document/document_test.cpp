// This file tests texts of bytes and of UTF-16, MTL and OBJ files in both encodings, and how MTL texts are
// split into places: statements, materials, names of maps.
#include <random>

#include <catch2/catch.hpp>

#include "assets/document/mtl_document.hpp"
#include "assets/document/text_edits.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "assets/obj/obj_mesh.hpp"
#include "core/errors.hpp"
#include "runtime/assets/mtl_texts.hpp"
#include "support/build_speed.hpp"
#include "support/error_of.hpp"

using namespace remap;

namespace {

const std::string kMark = "\xef\xbb\xbf";

std::string decoded(const std::string& bytes) { return utf8_text(MemorySource(bytes), "file"); }

std::string decoding_refusal(const std::string& bytes) {
  return error_of([&] { (void)decoded(bytes); });
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

namespace {

MtlMap map_of(const std::string& line) {
  const std::string text = "newmtl a\n" + line;
  return read_mtl_map(MtlDocument(text, "file"), 1);
}

}  // namespace

TEST_CASE("Statements belong to materials, whatever their white space and line endings", "[assets]") {
  for (const std::string ending : {"\n", "\r\n", "\r"}) {
    std::string text =
        "\xef\xbb\xbf# comment\nKd 1 1 1\n\n \tnewmtl\ta  b \n  Kd\t.1 .2 .3 \nfoo\n# c:\\\nnewmtl\nNs 5";
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += ending.size())
      text.replace(at, 1, ending);
    const MtlDocument document(text, "file");
    REQUIRE(document.materials().size() == 2);
    CHECK(document.line_ending() == ending);
    CHECK(document.materials()[0].name == "a  b");
    CHECK(document.materials()[1].name.empty());
    CHECK(document.materials()[0].first == 1);
    CHECK(document.materials()[0].last == 4);
    CHECK(document.materials()[1].last == 6);
    CHECK(document.raw(document.statements()[2].arguments) == ".1 .2 .3");
    CHECK(document.word(document.statements()[2]) == "kd");
    CHECK(document.statements().back().ending == TextSpan{text.size(), text.size()});
  }
}

TEST_CASE("A backslash joins lines, but not after a comment", "[assets]") {
  const std::string text = "newmtl a \\\r\n b\nKd 1 \\\n 0.5\\\n 0 # x\n# \\\nNs 4\n\\";
  const MtlDocument document(text, "file");
  REQUIRE(document.statements().size() == 4);
  CHECK(document.materials()[0].name == "a   b");
  CHECK(document.words(document.statements()[1]).size() == 5);
  CHECK(document.raw(document.words(document.statements()[1])[2]) == "0");
  CHECK(document.word(document.statements()[2]) == "ns");
}

TEST_CASE("Spans of statements cover every byte outside of comments and blank lines", "[assets]") {
  std::mt19937 random(7);
  const std::string letters = "aK \t#\\\r\n.1\0";
  for (int i = 0; i < 3000; ++i) {
    std::string text;
    for (std::size_t length = random() % 60; length > 0; --length) text += letters[random() % letters.size()];
    const MtlDocument document(text, "file");
    std::size_t at = 0;
    for (const MtlStatement& statement : document.statements()) {
      REQUIRE(statement.line.begin >= at);
      REQUIRE(statement.word.begin >= statement.line.begin);
      REQUIRE(statement.word.end <= statement.arguments.begin);
      REQUIRE(statement.arguments.end <= statement.line.end);
      REQUIRE(statement.line.end == statement.ending.begin);
      // Skipped text must be white space or a comment.
      for (const char c : text.substr(at, statement.line.begin - at)) {
        if (c == '#') break;
        REQUIRE(std::string(" \t\r\n\\").find(c) != std::string::npos);
      }
      at = statement.ending.end;
    }
  }
}

TEST_CASE("Names of maps are found between options", "[assets]") {
  // These lines are from the tests of tinyobjloader and from real files.
  CHECK(map_of("map_Kd -colorspace sRGB -o 0.1 diffuse.jpg").file == "diffuse.jpg");
  CHECK(map_of("map_Kd -colorspace sRGB -o 0.1 diffuse.jpg").offset[0] == 0.1);
  CHECK(map_of("map_Ks -s 0.1 0.2 specular.jpg").scale == std::array{0.1, 0.2});
  CHECK(map_of("map_Ns -t 0.1 0.2 0.3 high light.jpg").file == "high light.jpg");
  CHECK(map_of("map_Ns -t 0.1 0.2 0.3 high light.jpg").unusual == std::vector<std::string>{"-t"});
  CHECK_FALSE(map_of("map_Ns -mm 0 1 a.jpg").has_levels());
  CHECK(map_of("map_Ns -mm .5 a.jpg").base == 0.5);
  CHECK(map_of("map_Ns a.jpg -mm 0 2").gain == 2.0);
  CHECK(map_of("map_Kd -colorspace linear a.jpg").unusual.size() == 1);
  CHECK(map_of("map_Ns -colorspace linear -type sphere a.jpg").unusual.empty());
  CHECK(map_of("map_bump -imfchan r bump map 2.jpg -bm 1.5").file == "bump map 2.jpg");
  CHECK(map_of("map_bump -imfchan r bump map 2.jpg -bm 1.5").strength == 1.5);
  CHECK(map_of("map_bump -imfchan r bumpmap2.jpg -bm 1.5").channel == 'r');
  CHECK(map_of("map_Kd -texres 512 input.jpg").file == "input.jpg");
  CHECK(map_of("map_Kd -clamp on -blendu off a.png").clamps);
  CHECK(map_of("map_Kd .\\images\\x.png").file == "./images/x.png");
  CHECK(map_of("map_Kd -s 1 1 1 1").file == "1");
  CHECK(map_of("map_Kd -s").file.empty());
  CHECK(map_of("map_Kd").file.empty());
  CHECK(map_of("map_Kd   fuze uv.jpg  ").file == "fuze uv.jpg");
}

TEST_CASE("Numbers that cannot be read fail, others are clamped with a warning", "[assets]") {
  const auto read = [](const std::string& line) {
    const std::string text = "newmtl a\n" + line;
    const MtlDocument document(text, "file");
    std::vector<std::string> warnings;
    const std::string refusal = error_of([&] {
      MtlSurface surface;
      read_mtl_surface(document, document.materials()[0], MtlMaker::kText, surface, warnings);
      if (surface.exponent) warnings.push_back("n " + std::to_string(*surface.exponent));
    });
    return !refusal.empty() ? refusal : warnings.empty() ? "fine" : warnings.front();
  };
  CHECK(read("Ns -5") == "n -5.000000");
  CHECK(read("Ns nan") == "Ns nan: expected an exponent from 0 to 1000");
  CHECK(read("Ns inf") == "Ns inf: expected an exponent from 0 to 1000");
  CHECK(read("Ns shiny") == "Ns shiny: expected an exponent from 0 to 1000");
  CHECK(read("Ns") == "Ns : expected an exponent from 0 to 1000");
  CHECK(read("Ns 1e30") == "Ns 1e30: 1e+30 is outside of 0 to 10000 and becomes 10000");
  CHECK(read("Ns +20") == "n 20.000000");
  CHECK(read("Ks 2 .5 .5") == "Ks 2 .5 .5: 2 is outside of 0 to 1 and becomes 1");
  CHECK(read("Kd .5") == "fine");
  CHECK(read("Kd .5 x") == "fine");
  CHECK(read("Kd .5 .5") == "Kd .5 .5: expected three numbers from 0 to 1");
  CHECK(read("Kd spectral paint.rfl") ==
        "Kd spectral paint.rfl: spectral colors are not read (write red, green and blue)");
  CHECK(read("Kd xyz .1 .2 .3") == "Kd xyz .1 .2 .3: xyz colors are not read (write red, green and blue)");
}

TEST_CASE("A hundred thousand materials and a line of ten megabytes are read in seconds", "[assets][slow]") {
  std::string text;
  for (int i = 0; i < 100000; ++i)
    text += "newmtl m" + std::to_string(i) + "\nKd .5 .5 .5\nKs .5 .5 .5\nNs 50\n";
  text += "map_Kd " + std::string(10 << 20, 'x') + "\nKd ";
  for (int i = 0; i < (1 << 20); ++i) text += "0.1234567 ";
  const double seconds = seconds_of([&] { CHECK(MtlDocument(text, "file").materials().size() == 100000); });
  CHECK(seconds < 5.0);
}
