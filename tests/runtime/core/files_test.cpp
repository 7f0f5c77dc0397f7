// This file tests files that appear complete, and files that cannot be read.
#include "core/files.hpp"

#include <array>
#include <fstream>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;

TEST_CASE("write file: replaces the old one whole, and leaves it where it fails") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "sub" / "a.txt";
  write_file(path, "one");
  write_file(path, "two");
  CHECK(read_file(path) == "two");
  CHECK(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}) == 1);
  CHECK_THROWS_WITH(write_file(path / "b.txt", "x"), Catch::Contains("folder"));
  CHECK(read_file(path) == "two");
}

TEST_CASE("read file: a folder and a missing file have different messages") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_file(folder.path()), Catch::Contains("is a folder"));
  CHECK_THROWS_WITH(read_file(folder.path() / "no"), Catch::Contains("No such file"));
}

namespace {

// Returns the message of the error that `work` throws within two seconds. If `work` hangs, the test program
// ends.
template <typename Work>
std::string refusal(Work work) {
  ::alarm(2);
  const std::string message = error_of(work);
  ::alarm(0);
  return message;
}

}  // namespace

TEST_CASE("read file: pipes with a name, devices and files without end are refused at once") {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(refusal([&] { read_file(pipe); }) ==
        pipe.string() + ": is a named pipe, not a file (write its content to a file)");
  CHECK(refusal([] { read_file("/dev/zero"); }) ==
        "/dev/zero: is a device, not a file (give a regular file)");
  CHECK(refusal([&] { require_regular_file(pipe); }).ends_with("(write its content to a file)"));
  CHECK(refusal([&] { require_regular_file(folder.path() / "no"); }).ends_with("No such file or directory"));
  CHECK(refusal([&] { require_regular_file(folder.path()); }).ends_with("is a folder, not a file"));
}

TEST_CASE("read file: a pipe that the shell has opened is read to its end") {
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  REQUIRE(::write(ends[1], "content", 7) == 7);
  ::close(ends[1]);
  CHECK(read_file("/dev/fd/" + std::to_string(ends[0])) == "content");
  ::close(ends[0]);
}

TEST_CASE("read file: what is larger than a limit is refused, whatever its size claims") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  write_file(path, "12345");
  CHECK(read_file(path, 5) == "12345");
  CHECK(refusal([&] { read_file(path, 4); }) ==
        path.string() + ": has more than 4 bytes, which is the limit for such a file");
  CHECK(refusal([] {
          read_file("/proc/self/maps", 10);
        }).starts_with("/proc/self/maps: has more than 10 bytes"));
  std::filesystem::resize_file(path, kLargestFile + 1);
  CHECK(refusal([&] { read_file(path); }).find("has more than 256 MB") != std::string::npos);
}

TEST_CASE("unfinished files: the files of killed processes are removed, all others stay") {
  const TemporaryFolder folder;
  const pid_t dead = ::fork();
  if (dead == 0) {
    write_file(folder.path() / "of_child.txt", "x");
    std::ofstream(unfinished_name(folder.path() / "left.png")) << "half";
    ::_exit(0);
  }
  int status = 0;
  REQUIRE(::waitpid(dead, &status, 0) == dead);
  const std::string tag = owner_tag().substr(0, 9);
  const std::string mark = ".left.unfinished-" + tag + std::to_string(dead) + "-";
  const auto is_left = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      if (entry.path().filename().string().starts_with(mark)) return true;
    return false;
  };
  REQUIRE(is_left());
  CHECK(is_stale_owner(tag + std::to_string(dead)));
  const std::vector<std::string> others = {
      ".a.unfinished-" + owner_tag() + "-abc.png",                    // the process is alive
      ".a.unfinished-00000000-" + std::to_string(dead) + "-abc.png",  // another machine
      ".a.unfinished-" + std::to_string(dead) + "-abc.png",           // no machine
      ".a.unfinished-" + tag + std::to_string(dead) + "x-abc.png",    // not exactly the pattern
      ".a.unfinished-" + tag + "-1-abc.png",                          // not a process
      "a.unfinished-" + tag + std::to_string(dead) + "-abc.png"};     // not hidden
  for (const std::string& name : others) std::ofstream(folder.path() / name) << "x";
  write_file(folder.path() / "new.txt", "x");
  CHECK_FALSE(is_left());
  for (const std::string& name : others) CHECK(std::filesystem::exists(folder.path() / name));
}

TEST_CASE("commit file: a device or a pipe is not replaced") {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(refusal([&] { write_file(pipe, "x"); }) ==
        pipe.string() + ": cannot be written: is a device or a pipe, which a file must not replace");
  CHECK(std::filesystem::is_fifo(pipe));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}
