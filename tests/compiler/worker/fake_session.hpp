// This file holds what the tests of workers share: the fake worker with a fault, in its own folder.
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"
#include "worker/worker_renderer.hpp"

namespace remap {

// Returns true if the process has ended, or is a zombie of its new parent.
inline bool is_gone(pid_t id) {
  std::ifstream file("/proc/" + std::to_string(id) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t end = text.rfind(')');
  return end == std::string::npos || text.substr(end + 2, 1) == "Z";
}

class FakeSession {
 public:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  std::string command(const std::string& fault = "", const std::string& more = "") const {
    return std::string(REMAP_FAKE_WORKER) + " --log '" + path("log") + "' --fault '" + fault + "' " + more;
  }
  WorkerEntry entry(const std::string& fault = "", const std::string& more = "") const {
    return {"fake", command(fault, more), folder_.path().string(), ""};
  }
  WorkerSettings settings(bool cache = false) const {
    WorkerSettings settings;
    if (cache) settings.cache = folder_.path() / "cache";
    settings.processes = 2;
    settings.seconds = 60.0;
    settings.pause = std::chrono::milliseconds(0);
    return settings;
  }

  std::vector<std::string> log_lines(const std::string& opening) const {
    std::ifstream file(path("log"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);)
      if (line.starts_with(opening + " ")) lines.push_back(line.substr(opening.size() + 1));
    return lines;
  }
  std::size_t pictures() const { return log_lines("picture").size(); }

  // Waits for the end of every process in the workers' log. Returns false if a process still runs after ten
  // seconds.
  bool nobody_is_left() const {
    for (const std::string& id : log_lines("process")) {
      int tries = 0;
      while (!is_gone(std::stoi(id))) {
        if (++tries == 200) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    }
    return true;
  }

 private:
  TemporaryFolder folder_;
};

inline Material fake_material(double alpha = 0.2) {
  return {"fake/ggx", {{"alpha", {alpha}}, {"specular", {0.5}}, {"diffuse", {0.0}}, {"tint", {0.5}}}};
}

inline constexpr Scene kSmallScene{32, 1, {}};

// Returns the message of the kInput error that `work` throws.
template <typename Work>
std::string input_error(const Work& work) {
  return error_of(work, ErrorKind::kInput);
}

}  // namespace remap
