// This file tests texremap when the system fails: full disks, limits, signals. Results must be complete or
// missing. It also counts how often texremap opens a file, because each open is a request to a server on
// the storage of a render farm.
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <sys/mount.h>
#include <thread>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "support/skip.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

void write_pair_of(const Session& session, const std::string& extension, int size) {
  session.write_pair(extension, size, extension == "exr" ? OIIO::TypeHalf : OIIO::TypeUInt8);
}

// A SmallDisk is a small file system mounted on a folder, if the test has the permission to do so.
class SmallDisk {
 public:
  SmallDisk(const std::string& folder, const char* size) : folder_(folder) {
    fs::create_directory(folder);
    mounted_ = ::mount("tmpfs", folder.c_str(), "tmpfs", 0, size) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool is_mounted() const { return mounted_; }

 private:
  std::string folder_;
  bool mounted_ = false;
};

// This is the exit code if a later attempt may succeed: EX_TEMPFAIL of sysexits.h.
constexpr int kTryAgain = 75;

// Writes three sets: one of `large` x `large` texels between two small ones.
void write_sets(const Session& tree, const std::string& extension, int large) {
  for (const char* set : {"a", "b", "c"})
    tree.write_set(std::string("in/") + set, extension, OIIO::TypeUInt8, set[0] == 'b' ? large : kMapSize);
}

// Checks that the large set failed without leaving any file, and that the other sets are complete.
void check_others_whole(const Session& tree, const ProcessResult& result, const std::string& extension,
                        int exit_code) {
  INFO(result.errors);
  CHECK(result.exit_code == exit_code);
  CHECK(result.signal == 0);
  const auto sets = tree_report(result.output)["sets"];
  REQUIRE(sets.size() == 3);
  CHECK(set_states(result.output) == "cfc");
  CHECK_THAT(sets[1]["failure"].get<std::string>(), Contains("cannot be written"));
  CHECK_THAT(result.last_error(), Contains("1 of 3 sets failed"));
  std::vector<std::string> names;
  for (const char* name : {"a_rough.", "a_spec.", "c_rough.", "c_spec."}) names.push_back(name + extension);
  CHECK(tree.results() == names);
  for (const std::string& name : names) CHECK(tree.image("out/" + name).spec.width == kMapSize);
}

ProcessLimits at_most(rlim_t file_bytes) { return {.file_bytes = file_bytes}; }
const ProcessLimits kOrdinaryUser = {.keeps_permissions = true};

// Returns true if permissions of files are enforced for programs that the tests start. Otherwise skips the
// test.
bool permissions_hold(const Session& session) {
  const std::string file = session.path("unreadable");
  write_file(file, "");
  fs::permissions(file, fs::perms::none);
  if (run({"/bin/cat", file}, kOrdinaryUser).exit_code != 0) return true;
  skip("permissions", "root reads and writes every file, and cannot be kept from it here");
  return false;
}

// Waits until texremap has begun to write, then sends the signal.
ProcessResult interrupted(const Session& session, int signal) {
  // The compression must take seconds.
  Process process = session.start(REMAP_TEXREMAP " " + kConversion +
                                  " --roughness r.exr --specular s.exr --format png --threads 1");
  const auto has_begun = [&] {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(session.path("out"), none))
      if (entry.file_size(none) > 0) return true;
    return false;
  };
  while (process.is_running() && !has_begun()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  process.send(signal);
  return process.wait();
}

}  // namespace

TEST_CASE("texremap: a missing last byte is noticed", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("exr", "png", "tif", "jpg", "tga");
  write_pair_of(session, extension, 64);
  const std::string roughness = "r." + extension, specular = "s." + extension;
  require_success(session.convert(roughness, specular));
  const rlim_t size = fs::file_size(session.path("out/" + specular));
  for (const rlim_t missing : {rlim_t{1}, rlim_t{20}}) {
    const ProcessResult result = session.convert(roughness, specular, "--force", at_most(size - missing));
    INFO(extension << " " << missing << " bytes short: " << result.errors);
    CHECK(result.exit_code == 1);
  }
  CHECK(session.convert(roughness, specular, "--force", at_most(size)).exit_code == 0);
}

TEST_CASE("texremap: a full disk is reported and keeps the old results", "[needs]") {
  const Session session;
  const SmallDisk disk(session.path("out"), "size=200k");
  if (!disk.is_mounted()) return skip("mount", "a file system cannot be mounted here");
  write_pair_of(session, "exr", 64);
  require_success(session.convert("r.exr", "s.exr"));
  const std::string before = session.content("out/r.exr");
  write_pair_of(session, "exr", 512);
  const ProcessResult result = session.convert("r.exr", "s.exr", "--force");
  CHECK(result.exit_code == kTryAgain);
  CHECK_THAT(result.last_error(), Contains("cannot be written: No space left on device"));
  CHECK(session.file_count() == 2);
  CHECK(session.content("out/r.exr") == before);
}

TEST_CASE("texremap: a terminated run removes its files, and a killed one leaves none under its final name",
          "[slow]") {
  const Session session;
  session.write_pair("exr", 1600);
  const std::string roughness = session.content("r.exr"), specular = session.content("s.exr");
  const int signal = GENERATE(SIGTERM, SIGINT, SIGHUP, SIGKILL);
  const ProcessResult result = interrupted(session, signal);
  INFO(result.errors);
  if (signal == SIGKILL) {
    CHECK(result.signal == SIGKILL);
  } else {
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.last_error(), Contains("interrupted: no file was written"));
    CHECK(session.file_count() == 0);
  }
  CHECK(session.result_count() == 0);
  CHECK(session.content("r.exr") == roughness);
  CHECK(session.content("s.exr") == specular);
}

TEST_CASE("texremap tree: a file-size limit fails the sets that do not fit, and the others are complete",
          "[slow]") {
  const Session tree;
  const std::string extension = GENERATE("exr", "png", "tif", "tga", "jpg");
  write_sets(tree, extension, 256);
  for (const std::string threads : {"1", "2"}) {
    // The limit applies to the JSON output, too, which must fit.
    check_others_whole(tree, tree.convert_tree("--json --force --threads " + threads, at_most(20'000)),
                       extension, 1);
    fs::remove_all(tree.path("out"));
  }
}

TEST_CASE("texremap tree: a full disk fails the sets that do not fit, and the others are complete",
          "[needs]") {
  const Session tree;
  const SmallDisk disk(tree.path("out"), "size=100k");
  if (!disk.is_mounted()) return skip("mount", "a file system cannot be mounted here");
  write_sets(tree, "exr", 512);
  // Converts one set at a time. Otherwise other sets would find the disk full while the large one fills it.
  const ProcessResult result = tree.convert_tree("--json --threads 1");
  check_others_whole(tree, result, "exr", kTryAgain);
  CHECK_THAT(result.errors, Contains("No space left on device"));
}

TEST_CASE("texremap: an unwritable folder is named, and nothing is left in it", "[needs]") {
  const Session tree;
  if (!permissions_hold(tree)) return;
  write_sets(tree, "png", kMapSize);
  tree.write_pair("png", 16, OIIO::TypeUInt8);
  fs::create_directory(tree.path("out"));
  fs::permissions(tree.path("out"), fs::perms(0555));
  const ProcessResult one = tree.convert("r.png", "s.png", {}, kOrdinaryUser);
  CHECK(one.exit_code == 1);
  CHECK_THAT(one.last_error(), Contains("out/r.png: cannot be written: Permission denied"));
  const ProcessResult all = tree.convert_tree({}, kOrdinaryUser);
  CHECK(all.exit_code == 1);
  CHECK_THAT(all.errors, Contains("out/a_rough.png: cannot be written: Permission denied"));
  CHECK_THAT(all.last_error(), Contains("3 sets failed"));
  CHECK(tree.file_count() == 0);
  fs::permissions(tree.path("out"), fs::perms::owner_all);
}

TEST_CASE("texremap: unreadable files and folders are named, and the others are converted", "[needs]") {
  const Session tree;
  if (!permissions_hold(tree)) return;
  write_sets(tree, "png", kMapSize);
  tree.map("in/locked/d_rough.png", kGrey);
  fs::permissions(tree.path("in/locked"), fs::perms::none);
  fs::permissions(tree.path("in/b_spec.png"), fs::perms::none);
  const ProcessResult result = tree.convert_tree({"--recursive"}, kOrdinaryUser);
  fs::permissions(tree.path("in/locked"), fs::perms::owner_all);
  INFO(result.errors);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.errors, Contains("in/locked: cannot be read: Permission denied"));
  CHECK_THAT(result.errors, Contains("in/b_spec.png: cannot be read: Permission denied"));
  CHECK(tree.results() == Names{"a_rough.png", "a_spec.png", "c_rough.png", "c_spec.png"});
}

TEST_CASE("texremap: no output is written through a link") {
  const Session session;
  session.write_pair("png", 16, OIIO::TypeUInt8);
  fs::create_directory(session.path("out"));
  fs::create_symlink(session.path("elsewhere.png"), session.path("out/s.png"));
  const ProcessResult out = session.convert("r.png", "s.png");
  CHECK(out.exit_code == 1);
  CHECK_THAT(out.last_error(), Contains("out/s.png: already exists"));
  // --force replaces the link, not its target.
  CHECK(session.convert("r.png", "s.png", "--force").exit_code == 0);
  CHECK_FALSE(fs::exists(session.path("elsewhere.png")));
  CHECK_FALSE(fs::is_symlink(session.path("out/s.png")));
}

namespace {

const Words kOfTree = "convert in --recursive --from mitsuba/ward --to mitsuba/as -o out --threads 2 --quiet";
const Words kOfManifest =
    "convert --manifest sets.jsonl --from mitsuba/ward --to mitsuba/as -o out --part 1/1 --quiet";

// Writes a file of two parts, of which one is the specular color.
void write_parts(const std::string& path) {
  OIIO::ImageSpec color = test_spec(kMapSize, kMapSize, kColor, OIIO::TypeHalf);
  std::vector<OIIO::ImageSpec> specs = {color, test_spec(kMapSize, kMapSize, {"U", "V"}, OIIO::TypeFloat)};
  specs[0].attribute("oiio:subimagename", "specular");
  specs[1].attribute("oiio:subimagename", "depth");
  const auto output = OIIO::ImageOutput::create(path);
  REQUIRE(output->open(path, 2, specs.data()));
  for (int part = 0; part < 2; ++part) {
    if (part > 0) REQUIRE(output->open(path, specs[1], OIIO::ImageOutput::AppendSubimage));
    const std::vector<float> texels(
        static_cast<std::size_t>(kMapSize * kMapSize * specs[static_cast<std::size_t>(part)].nchannels),
        0.3f);
    REQUIRE(output->write_image(OIIO::TypeFloat, texels.data()));
  }
  REQUIRE(output->close());
}

// Writes a set of each format: two maps that are converted, and a normal map that is not.
void write_library(const Session& tree) {
  for (const std::string format : {"png", "tga", "jpg", "bmp", "exr", "tif"}) {
    const auto type = format == "exr" ? OIIO::TypeHalf : OIIO::TypeUInt8;
    tree.write_set("in/" + format, format, type);
    tree.map("in/" + format + "_normal." + format, kColor, type);
  }
  tree.map("in/parts_rough.exr", kGrey, OIIO::TypeHalf);
  write_parts(tree.path("in/parts_spec.exr"));
}

// Checks that each file in `in` and `out` is opened once, and returns their number. A result is counted under
// its final name.
std::size_t opened_once(const Session& tree, const Words& words) {
  fs::remove(tree.path("opens.txt"));
  const ProcessResult result =
      tree.run(Words("/usr/bin/env LD_PRELOAD=" REMAP_FAULTY_STORAGE) +
               Words{"OPENS_LOG=" + tree.path("opens.txt")} + REMAP_TEXREMAP + words);
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  std::map<std::string, int> counts;
  std::ifstream lines(tree.path("opens.txt"));
  for (std::string line; std::getline(lines, line);) {
    const fs::path path = line;
    const std::string folder = path.parent_path().filename().string();
    std::string name = path.filename().string();
    if (name.empty() || name.starts_with(".texremap") || (folder != "in" && folder != "out")) continue;
    if (const std::size_t mark = name.find(".unfinished-"); mark != std::string::npos)
      name = name.substr(1, mark - 1) + path.extension().string();
    ++counts[folder + "/" + name];
  }
  for (const auto& [name, count] : counts) {
    INFO(name);
    CHECK(count == 1);
  }
  return counts.size();
}

}  // namespace

// The writers of TIFF, and of EXR with several parts, open the file again through its descriptor.
TEST_CASE("texremap opens: every input once and every result once by its name") {
  const Session tree;
  write_library(tree);
  CHECK(opened_once(tree, kOfTree) == 40);
  opened_once(tree, kOfTree);  // in a second run, each finished file is read once, to compare it
}

TEST_CASE("texremap opens: a set of a manifest and a turned normal map are opened once") {
  const Session tree;
  tree.write_set("in/a", "png");
  REQUIRE(tree.texremap("index in -o sets.jsonl").exit_code == 0);
  CHECK(opened_once(tree, kOfManifest) == 4);
  fs::remove_all(tree.path("in"));
  for (const char* name : {"in/wood_BaseColor.png", "in/wood_Normal_OpenGL.png"}) tree.map(name, kColor);
  for (const char* name : {"in/wood_Roughness.png", "in/wood_Metallic.png"}) tree.map(name, kGrey);
  opened_once(tree, "convert in --from metallic --to unreal -o out --force --quiet");
}
