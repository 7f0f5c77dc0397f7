// This file tests texremap when the system fails: full disks, limits, signals. Results must be complete or
// missing.
#include <chrono>
#include <csignal>
#include <sys/mount.h>
#include <thread>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_tree.hpp"
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
void write_sets(const Tree& tree, const std::string& extension, int large) {
  for (const char* set : {"a", "b", "c"})
    for (const char* map : {"_rough.", "_spec."})
      tree.map(std::string("in/") + set + map + extension, map[1] == 'r' ? kGrey : kColor, OIIO::TypeUInt8,
               set[0] == 'b' ? large : kTreeMapSize);
}

// Checks that the large set failed without leaving any file, and that the other sets are complete.
void check_others_whole(const Tree& tree, const ProcessResult& result, const std::string& extension,
                        int exit_code) {
  INFO(result.errors);
  CHECK(result.exit_code == exit_code);
  CHECK(result.signal == 0);
  const auto sets = tree_report(result.output)["sets"];
  REQUIRE(sets.size() == 3);
  CHECK(sets[0]["state"] == "converted");
  CHECK(sets[1]["state"] == "failed");
  CHECK(sets[2]["state"] == "converted");
  CHECK_THAT(sets[1]["failure"].get<std::string>(), Contains("cannot be written"));
  CHECK_THAT(result.last_error(), Contains("1 of 3 sets failed"));
  std::vector<std::string> names;
  for (const char* name : {"a_rough.", "a_spec.", "c_rough.", "c_spec."}) names.push_back(name + extension);
  CHECK(tree.results() == names);
  for (const std::string& name : names) CHECK(tree.image("out/" + name).spec.width == kTreeMapSize);
}

ProcessLimits at_most(rlim_t file_bytes) {
  ProcessLimits limits;
  limits.file_bytes = file_bytes;
  return limits;
}
ProcessLimits ordinary_user() {
  ProcessLimits limits;
  limits.keeps_permissions = true;
  return limits;
}

// Returns true if permissions of files are enforced for programs that the tests start. Otherwise skips the
// test.
bool permissions_hold(const Session& session) {
  const std::string file = session.path("unreadable");
  write_file(file, "");
  fs::permissions(file, fs::perms::none);
  if (run({"/bin/cat", file}, ordinary_user()).exit_code != 0) return true;
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
  const Tree tree;
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
  const Tree tree;
  const SmallDisk disk(tree.path("out"), "size=100k");
  if (!disk.is_mounted()) return skip("mount", "a file system cannot be mounted here");
  write_sets(tree, "exr", 512);
  // Converts one set at a time. Otherwise other sets would find the disk full while the large one fills it.
  const ProcessResult result = tree.convert_tree("--json --threads 1");
  check_others_whole(tree, result, "exr", kTryAgain);
  CHECK_THAT(result.errors, Contains("No space left on device"));
}

TEST_CASE("texremap: an unwritable folder is named, and nothing is left in it", "[needs]") {
  const Tree tree;
  if (!permissions_hold(tree)) return;
  write_sets(tree, "png", kTreeMapSize);
  tree.write_pair("png", 16, OIIO::TypeUInt8);
  fs::create_directory(tree.path("out"));
  fs::permissions(tree.path("out"), fs::perms(0555));
  const ProcessResult one = tree.convert("r.png", "s.png", {}, ordinary_user());
  CHECK(one.exit_code == 1);
  CHECK_THAT(one.last_error(), Contains("out/r.png: cannot be written: Permission denied"));
  const ProcessResult all = tree.convert_tree({}, ordinary_user());
  CHECK(all.exit_code == 1);
  CHECK_THAT(all.errors, Contains("out/a_rough.png: cannot be written: Permission denied"));
  CHECK_THAT(all.last_error(), Contains("3 sets failed"));
  CHECK(tree.file_count() == 0);
  fs::permissions(tree.path("out"), fs::perms::owner_all);
}

TEST_CASE("texremap: unreadable files and folders are named, and the others are converted", "[needs]") {
  const Tree tree;
  if (!permissions_hold(tree)) return;
  write_sets(tree, "png", kTreeMapSize);
  tree.map("in/locked/d_rough.png", kGrey);
  fs::permissions(tree.path("in/locked"), fs::perms::none);
  fs::permissions(tree.path("in/b_spec.png"), fs::perms::none);
  const ProcessResult result = tree.convert_tree({"--recursive"}, ordinary_user());
  fs::permissions(tree.path("in/locked"), fs::perms::owner_all);
  INFO(result.errors);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.errors, Contains("in/locked: cannot be read: Permission denied"));
  CHECK_THAT(result.errors, Contains("in/b_spec.png: cannot be read: Permission denied"));
  CHECK(tree.results() == std::vector<std::string>{"a_rough.png", "a_spec.png", "c_rough.png", "c_spec.png"});
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
