// This file tests what strangers put into folders: programs, links, pipes, names and images that were made to
// do harm. The cases are those of docs/security.md.
#include <csignal>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/texremap_session.hpp"
#include "core/files.hpp"
#include "core/json.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const Words kToGgx = "--from mitsuba/ward --to mitsuba/ggx --specular 0.04";
const Words kOfTree = "convert in" + kToGgx + "--quiet -o out";
const std::string kSpecGloss =
    R"("materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":{"glossinessFactor":0.5}}}])";

class HostileFolder : public Session {
 public:
  // Writes an asset that uses a file as its buffer.
  void put_asset(const std::string& name, const std::string& part) const {
    put(name, R"({"asset":{"version":"2.0"},"buffers":[{"uri":")" + part + R"(","byteLength":4}],)" +
                  kSpecGloss + "}");
  }
  void put_textured(const std::string& name, const std::string& image) const {
    put(name, R"({"asset":{"version":"2.0"},"images":[{"uri":")" + image +
                  R"("}],"textures":[{"source":0}],"materials":[{"extensions":)"
                  R"({"KHR_materials_pbrSpecularGlossiness":{"specularFactor":[0.3,0.2,0.1],)"
                  R"("diffuseTexture":{"index":0}}}}]})");
  }
  void link(const fs::path& to, const std::string& name) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    fs::create_symlink(to, path(name));
  }
  // Edits the manifest. Anybody can do this, because its hash has no key.
  void change_manifest(const std::string& from, const std::string& to) const {
    std::string text = content("m.jsonl");
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
    put("m.jsonl", text);
  }
};

mode_t mode_of(const fs::path& file) {
  struct stat found {};
  REQUIRE(::stat(file.c_str(), &found) == 0);
  return found.st_mode & 07777u;
}

bool has_unfinished(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename().string().find(".unfinished-") != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("texremap hostile: a copy has the permissions of new files, whatever those of its source") {
  const HostileFolder folder;
  folder.put_asset("in/a.gltf", "payload.bin");
  folder.put("in/payload.bin", std::string(4096, 'x'));
  folder.map("in/sets/x_roughness.png", kGrey);
  folder.map("in/sets/x_normal.png", kColor);
  for (const char* name : {"in/payload.bin", "in/sets/x_normal.png"})
    REQUIRE(::chmod(folder.path(name).c_str(), 04777) == 0);
  const auto run = [&](const std::string& words) {
    return folder.run({"/bin/sh", "-c", "umask 077 && exec " REMAP_TEXREMAP " " + words}).exit_code;
  };
  CHECK(run("convert in/a.gltf --to gltf -o out") == 0);
  CHECK(run("convert in/sets --from mitsuba/ward --to mitsuba/ggx --specular 0.04 -o sets") == 0);
  for (const char* name : {"out/a.gltf", "out/payload.bin", "sets/x_normal.png", "sets/x_roughness.png"}) {
    INFO(name);
    CHECK(mode_of(folder.path(name)) == 0600);
  }
}

TEST_CASE("texremap hostile: images of one stem give new images of two names") {
  const HostileFolder folder;
  folder.map("in/wood.png", kColor);
  folder.map("in/wood.jpg", kColor);
  folder.put_textured("in/a.gltf", "wood.png");
  folder.put_textured("in/b.gltf", "wood.jpg");
  folder.put_textured("in/x/a.gltf", "../wood.png");
  const std::string command = "convert in --assets --recursive --to gltf -o out";
  CHECK(folder.texremap(command).exit_code == 0);
  CHECK_THAT(folder.texremap(command + "").errors, Contains("3 done before"));
  for (const char* name : {"a_wood_baseColor.png", "b_wood_baseColor.png", "a_2_wood_baseColor.png"}) {
    INFO(name);
    CHECK(fs::exists(folder.path(std::string("out/") + name)));
  }
  CHECK_THAT(folder.content("out/x/a.gltf"), Contains("../a_2_wood_baseColor.png"));
}

TEST_CASE("texremap hostile: an asset is never the part of another one, nor is what the program notes") {
  const HostileFolder folder;
  folder.put("in/b.gltf", R"({"asset":{"version":"2.0"},)" + kSpecGloss + "}");
  folder.put_asset("in/z.gltf", "b.gltf");
  folder.put_asset("in/y.gltf", ".texremap.jsonl");
  folder.put("in/.texremap.jsonl", "not a journal");
  const ProcessResult run = folder.texremap("convert in --assets --to gltf -o out --json");
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.errors, Contains("out/b.gltf: would be written twice, from the conversion of in/b.gltf "
                                  "and from in/b.gltf") &&
                             Contains("has a name that texremap uses for its own files (rename it)"));
  CHECK_THAT(folder.content("out/b.gltf"), Contains("pbrMetallicRoughness"));
  CHECK_FALSE(folder.exists("out/z.gltf"));
  CHECK(folder.content("out/.texremap.jsonl").starts_with("{\"conversion\""));
}

TEST_CASE("texremap hostile: of two sets that differ in case alone the second is refused") {
  const HostileFolder folder;
  const std::string large = "\xc3\x84", small = "\xc3\xa4";  // Ä and ä
  for (const std::string& name : {std::string("Rock"), std::string("rock"), large, small})
    folder.map("in/" + name + "_roughness.png", kGrey);
  const ProcessResult run = folder.texremap(kOfTree);
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.errors, Contains("would be written twice, from the set of in/Rock_roughness.png and from "
                                  "the set of in/rock_roughness.png"));
  CHECK(folder.results() ==
        Names{"Rock_roughness.png", "Rock_specular.png", large + "_roughness.png", large + "_specular.png"});
  CHECK_THAT(folder.texremap("index in -o m.jsonl").errors,
             Contains("(rename one of the sets; A and a are the same letter here"));
}

TEST_CASE("texremap hostile: links that others planted in the output folder are not followed") {
  const HostileFolder folder;
  folder.map("in/x_roughness.png", kGrey);
  folder.put("rc", "alias ll=ls\n");
  folder.link("../rc", "out/.texremap.jsonl");
  CHECK_THAT(folder.texremap(kOfTree).last_error(), Contains("out/.texremap.jsonl: is a link, belongs to"));
  CHECK(folder.content("rc") == "alias ll=ls\n");
  CHECK_FALSE(folder.exists("out/x_roughness.png"));

  fs::remove(folder.path("out/.texremap.jsonl"));
  fs::create_directory(folder.path("elsewhere"));
  folder.link("../elsewhere", "out/.texremap-parts");
  REQUIRE(folder.texremap("index in -o m.jsonl --quiet").exit_code == 0);
  CHECK(folder
            .texremap(Words("convert --manifest m.jsonl --part 1/1 --from mitsuba/ward --to mitsuba/ggx "
                            "--specular 0.04 --quiet -o out"))
            .exit_code == 1);
  CHECK(fs::is_empty(folder.path("elsewhere")));
}

TEST_CASE("texremap hostile: names of unfinished files cannot be known before they are there") {
  const HostileFolder folder;
  const fs::path first = unfinished_name(folder.path("a.png")),
                 second = unfinished_name(folder.path("a.png"));
  CHECK(first != second);
  CHECK(first.filename().string().starts_with(".a.unfinished-" + owner_tag() + "-"));
  const std::string longest = std::string(250, 'n') + ".txt";
  CHECK(unfinished_name(folder.path(longest)).filename().string().size() == 255);
  folder.put(longest, "x");
  CHECK(folder.content(longest) == "x");
  std::string umlauts = ".txt";
  for (int i = 0; i < 120; ++i) umlauts = "\xc3\xa4" + umlauts;
  CHECK(is_utf8(unfinished_name(folder.path(umlauts)).filename().string()));
}

TEST_CASE("texremap hostile: a manifest leads nowhere else") {
  const HostileFolder folder;
  folder.map("lib/x_roughness.png", kGrey);
  folder.map("other/x_roughness.png", kGrey);
  const auto refusal = [&](const std::string& from, const std::string& to) {
    REQUIRE(folder.texremap("index lib -o m.jsonl --quiet --force").exit_code == 0);
    folder.change_manifest(from, to);
    const ProcessResult run = folder.texremap(
        "convert --manifest m.jsonl --part 1/1 --from mitsuba/ward --to mitsuba/ggx --specular 0.04 --quiet "
        "-o deep/out");
    CHECK(run.exit_code == 1);
    CHECK_FALSE(folder.exists("deep"));
    return run.last_error();
  };
  const auto check = [&](const std::string& field, const std::string& value, const std::string& message) {
    CHECK(refusal("\"" + field + "\":\"" + (field == "name" ? "x" : "") + "\"",
                  "\"" + field + "\":\"" + value + "\"") ==
          "texremap: m.jsonl: line 2: " + message + " (run texremap index again)");
  };
  check("folder", "../other", "\"../other\" leads out of its folder");
  check("folder", "/etc", "\"/etc\" is an absolute path");
  check("name", "x/y", "\"x/y\" is not a name");
  check("name", "x\\ny", "\"x\\x0ay\" has control characters");
  folder.put_asset("as/a.gltf", "a.bin");
  REQUIRE(folder.texremap("index as --assets -o m.jsonl --quiet --force").exit_code == 0);
  folder.change_manifest(R"("a.gltf")", "\"" + folder.path("as/a.gltf") + "\"");
  CHECK_THAT(folder.texremap("convert --manifest m.jsonl --to gltf -o deep --force").last_error(),
             Contains("is an absolute path (run texremap index again)"));
}

TEST_CASE("texremap hostile: links out of the folder of the inputs are read when they are asked for") {
  const HostileFolder folder;
  folder.put("secret", "1234");
  folder.put_asset("in/a.gltf", "payload.bin");
  folder.link("../secret", "in/payload.bin");
  folder.put_asset("in/tex/b.gltf", "p.bin");
  folder.put("in/real/p.bin", "5678");
  folder.link("../real/p.bin", "in/tex/p.bin");
  const ProcessResult run = folder.texremap("convert in --assets --recursive --to gltf -o out");
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.errors, Contains("in/payload.bin: is a link that leads out of") &&
                             Contains("(--follow-links reads it)"));
  CHECK_FALSE(folder.exists("out/payload.bin"));
  CHECK(folder.content("out/tex/p.bin") == "5678");  // the link stays inside the folder
  CHECK(folder.texremap("convert in/a.gltf --to gltf -o one").exit_code == 1);
  CHECK(folder.texremap("convert in/a.gltf --to gltf -o one --follow-links").exit_code == 0);
  CHECK(folder.content("one/payload.bin") == "1234");

  folder.map("sets/x_roughness.png", kGrey);
  folder.link("../secret", "sets/x_normal.png");
  CHECK(folder.texremap("convert sets --from mitsuba/ward --to mitsuba/ggx --specular 0.04 -o copies")
            .exit_code == 1);
  CHECK_FALSE(folder.exists("copies/x_normal.png"));
}

TEST_CASE("texremap hostile: pipes and files without end in the place of its files end nothing") {
  const HostileFolder folder;
  folder.map("in/x_roughness.png", kGrey);
  REQUIRE(::mkfifo(folder.path("m.jsonl").c_str(), 0600) == 0);
  CHECK_THAT(folder.texremap("convert --manifest m.jsonl --part 1/1 --to gltf -o out").last_error(),
             Contains("is a named pipe, not a file"));
  fs::create_directories(folder.path("in/.texremap-parts"));
  REQUIRE(::mkfifo(folder.path("in/.texremap-parts/a.journal").c_str(), 0600) == 0);
  folder.put("in/.texremap.jsonl", "");
  // The journal becomes a file of zeros without a line break.
  fs::resize_file(folder.path("in/.texremap.jsonl"), std::uintmax_t{8} << 30);
  CHECK(folder.texremap(kOfTree).exit_code == 0);
  fs::remove(folder.path("out/.texremap.jsonl"));
  REQUIRE(::mkfifo(folder.path("out/.texremap.jsonl").c_str(), 0600) == 0);
  CHECK_THAT(folder.texremap(kOfTree + "--force").last_error(), Contains("is not a file"));
}

TEST_CASE("texremap hostile: a decoder that crashes costs one set, one asset, one finding", "[slow]") {
  const HostileFolder folder;
  for (const char* name : {"a", "bad", "c"}) {
    folder.map("in/" + std::string(name) + "_roughness.png", kGrey);
    folder.put_textured("as/" + std::string(name) + ".gltf", std::string(name) + ".png");
    folder.map("as/" + std::string(name) + ".png", kColor);
  }
  const auto crashing = [&](const Words& words, const std::string& name = "bad") {
    return folder.run(Words("/usr/bin/env LD_PRELOAD=" REMAP_FAULTY_STORAGE " FAULT_NAME=" + name +
                            " FAULT_SIGNAL=" + std::to_string(SIGABRT)) +
                      REMAP_TEXREMAP + words);
  };
  for (const char* threads : {"1", "2"}) {
    fs::remove_all(folder.path("out"));
    const ProcessResult run = crashing(kOfTree + "--threads" + threads);
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.errors,
               Contains("failed: in/bad: the process that converted these files was ended by signal 6"));
    CHECK(run.last_error() == "texremap: 1 of 3 sets failed");
    CHECK(folder.results().size() == 4);
    CHECK_FALSE(has_unfinished(folder.path("out")));
  }
  const ProcessResult assets =
      crashing(Words("convert as --assets --to gltf -o assets --threads 1"), "bad.png");
  CHECK(assets.exit_code == 1);
  CHECK_THAT(assets.errors, Contains("2 assets converted in ") && Contains(" s, 1 failed") &&
                                Contains("the process that converted these files was ended by signal 6"));
  const ProcessResult one =
      crashing(Words("convert --from mitsuba/ward --to mitsuba/ggx --roughness in/bad_roughness.png "
                     "--specular 0.04 -o one"));
  CHECK(one.exit_code == 1);
  CHECK_THAT(one.last_error(),
             Contains("in/bad_roughness.png: the process that converted these files was ended"));
  const ProcessResult checked = crashing(Words("check in"));
  CHECK(checked.exit_code == 1);
  CHECK_THAT(checked.errors, Contains("the process that converted these files was ended by signal 6"));
}

TEST_CASE(
    "texremap hostile: images are read by their content, and their claims are compared with their size") {
  const HostileFolder folder;
  const std::string head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), end("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  // This is the head of a PNG of 32768 x 32768 texels of 16 bits in four channels, interlaced.
  const std::string bomb = head + std::string("\0\0\x80\0\0\0\x80\0\x10\6\0\0\1\xe3\xeb\x4f\xaa", 17) +
                           std::string("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12) + end;
  folder.put("in/bomb_roughness.png", bomb);
  folder.put("in/dpx_roughness.png", "SDPX" + std::string(2044, '\0'));
  folder.put("in/iff_roughness.png", "FOR4" + std::string(100, '\0'));
  std::string bmp("BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x10\0\0\0\x10\0\0\0\1\0\x18\0\2\0\0\0", 34);
  folder.put("in/bmp_roughness.bmp", bmp + std::string(1000, '\0'));
  bmp.replace(14, 2, "\x0c\1", 2);
  folder.put("in/old_roughness.bmp", bmp + std::string(1000, '\0'));
  folder.map("in/good_roughness.png", kGrey);
  fs::copy_file(folder.path("in/good_roughness.png"), folder.path("in/named_roughness.tif"));
  const ProcessResult run = folder.texremap(kOfTree);
  CHECK(run.exit_code == 1);
  CHECK(run.last_error() == "texremap: 5 of 7 sets failed");
  CHECK_THAT(run.errors,
             Contains("bomb_roughness.png: is damaged: its size of 32768x32768 is too large for a file of") &&
                 Contains("is DPX, which texremap does not read (convert it to PNG)") &&
                 Contains("is IFF, which texremap does not read") && Contains("compression 2 of 24 bits") &&
                 Contains("a header of 268 bytes"));
  CHECK_THAT(folder.texremap("check in --quiet").errors, Contains("32768x32768"));
  folder.map("large/x_roughness.tif", kColor, OIIO::TypeUInt8, 2048);
  CHECK_THAT(
      folder
          .texremap("convert large --from mitsuba/ward --to mitsuba/ggx --specular 0.04 --memory-limit 1 -o "
                    "limited")
          .errors,
      Contains("of memory, and an image of this run may take 1 MB (--memory-limit MB"));
}
