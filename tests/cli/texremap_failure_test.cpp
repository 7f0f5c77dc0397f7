// texremap when the system fails it: full disks, limits, signals. Results appear whole or not at all.
#include <chrono>
#include <csignal>
#include <sys/mount.h>
#include <thread>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

void write_pair_of(const Session& session, const std::string& extension, int size) {
  session.write_pair(extension, size, extension == "exr" ? OIIO::TypeHalf : OIIO::TypeUInt8);
}

// A file system of its own in a folder, where the test may mount one.
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

// Waits until texremap has begun to write, then sends the signal.
ProcessResult interrupted(const Session& session, int signal) {
  std::vector<std::string> words = session.conversion("r.exr", "s.exr");
  words.insert(words.begin(), REMAP_TEXREMAP);
  words.insert(words.end(), {"--format", "png", "--threads", "1"});  // compresses for seconds
  Process process(words);
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

TEST_CASE("texremap: a file-size limit is a failure for every format and leaves nothing") {
  const Session session;
  const std::string extension = GENERATE("exr", "png", "tif", "jpg", "tga");
  write_pair_of(session, extension, 256);
  for (const rlim_t limit : {rlim_t{500}, rlim_t{20'000}}) {  // the message must fit, too
    const std::string threads = limit == 500 ? "1" : "2";
    const ProcessResult result =
        session.convert("r." + extension, "s." + extension, {"--quiet", "--threads", threads}, {limit});
    INFO(extension << " limited to " << limit << ": " << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(result.signal == 0);
    CHECK_THAT(result.last_error(), Contains("cannot be written"));
    CHECK(session.file_count() == 0);
  }
}

TEST_CASE("texremap: the last byte that does not fit is noticed") {
  const Session session;
  const std::string extension = GENERATE("exr", "png", "tif", "jpg", "tga");
  write_pair_of(session, extension, 64);
  const std::string roughness = "r." + extension, specular = "s." + extension;
  REQUIRE(session.convert(roughness, specular).exit_code == 0);
  const rlim_t size = fs::file_size(session.path("out/" + specular));
  for (const rlim_t missing : {rlim_t{1}, rlim_t{20}}) {
    const ProcessResult result = session.convert(roughness, specular, {"--force"}, {size - missing});
    INFO(extension << " " << missing << " bytes short: " << result.errors);
    CHECK(result.exit_code == 1);
  }
  CHECK(session.convert(roughness, specular, {"--force"}, {size}).exit_code == 0);
}

TEST_CASE("texremap: a full disk is a failure that says so and leaves the old results") {
  const Session session;
  const SmallDisk disk(session.path("out"), "size=200k");
  if (!disk.is_mounted()) {
    WARN("skipped: a file system cannot be mounted here");
    return;
  }
  write_pair_of(session, "exr", 64);
  REQUIRE(session.convert("r.exr", "s.exr").exit_code == 0);
  const std::string before = read_file(session.path("out/r.exr"));
  write_pair_of(session, "exr", 512);
  const ProcessResult result = session.convert("r.exr", "s.exr", {"--force"});
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.last_error(), Contains("cannot be written: No space left on device"));
  CHECK(session.file_count() == 2);
  CHECK(read_file(session.path("out/r.exr")) == before);
}

TEST_CASE("texremap: terminated in mid-run, it takes its files away") {
  const Session session;
  session.write_pair("exr", 1600);
  const std::string roughness = read_file(session.path("r.exr")), specular = read_file(session.path("s.exr"));
  const int signal = GENERATE(SIGTERM, SIGINT);
  const ProcessResult result = interrupted(session, signal);
  INFO(result.errors);
  CHECK(result.exit_code == 1);
  CHECK(result.signal == 0);
  CHECK_THAT(result.last_error(), Contains("interrupted: no file was written"));
  CHECK(session.file_count() == 0);
  CHECK(read_file(session.path("r.exr")) == roughness);
  CHECK(read_file(session.path("s.exr")) == specular);
}

TEST_CASE("texremap: killed in mid-run, no file has its final name") {
  const Session session;
  session.write_pair("exr", 1600);
  const std::string roughness = read_file(session.path("r.exr")), specular = read_file(session.path("s.exr"));
  const ProcessResult result = interrupted(session, SIGKILL);
  CHECK(result.signal == SIGKILL);
  CHECK(session.result_count() == 0);
  CHECK(read_file(session.path("r.exr")) == roughness);
  CHECK(read_file(session.path("s.exr")) == specular);
}
