// This file runs one worker process: it sends a request, waits for its answer, and repeats this.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "look/image.hpp"
#include "remap/error.hpp"
#include "worker/child_process.hpp"
#include "worker/protocol.hpp"

namespace remap {

// A WorkerEntry is an entry in a list of workers (compiler/adapters/PROTOCOL.md).
struct WorkerEntry {
  std::string name;     // prefix of the worker's models; if empty, any
  std::string command;  // run by the shell
  std::string folder;   // folder of the list, which the worker gets as REMAP_WORKER_FOLDER
  std::string install;  // how to install it, shown if it does not start; may be empty
};

// A WorkerSettings decides how workers are run and how their pictures are kept.
struct WorkerSettings {
  std::optional<std::filesystem::path> cache;  // if empty, every picture is rendered
  std::filesystem::path folder;                // folder for pictures in transit; if empty, a folder in memory
  unsigned processes = 0;  // limit of processes of one worker at once; 0: one for each core
  double seconds = 120.0;  // limit for one answer
  unsigned threads = 1;    // number of threads in each process
  const std::atomic<bool>* cancelled = nullptr;  // if true, a wait ends with kInterrupted
  std::function<void()> on_picture;              // called after every picture, from any thread
  // called before the first process starts, because processes use files that must be removed at the end
  std::function<void()> on_start;
  // This is called from any thread with urgent warnings: the first process that is lost, the first damaged
  // picture of the cache, and that the cache cannot be written. The run continues.
  std::function<void(const std::string&)> on_warning;
  // This is the pause before a picture is rendered again after its process was lost. It doubles before the
  // third attempt.
  std::chrono::milliseconds pause{1000};
};

// A LostWorker means that a worker's process has ended, or was ended because it did not answer in time. The
// request need not be the reason, so another process may answer it.
class LostWorker : public Error {
 public:
  explicit LostWorker(const std::string& message) : Error(ErrorKind::kInput, message) {}
};

class Worker {
 public:
  // Starts the process and asks for its description. Pictures are exchanged through files whose names begin
  // with `files` and belong to this worker. Throws kInput if the process cannot be started or violates the
  // protocol, and LostWorker if it does not answer.
  Worker(const WorkerEntry& entry, const WorkerSettings& settings, std::filesystem::path files);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  const WorkerDescription& description() const { return description_; }

  // Renders a picture. Throws LostWorker if no answer comes, and kInput if rendering fails, or if the picture
  // has forbidden values (picture_fault()). If the worker answered with an error, is_usable() stays true
  // and the worker accepts further requests.
  //
  // Every message about a worker names the worker and the request. If the worker was ended, the message has
  // the end of its log. A message has at most remap::kLongestMessage bytes and no control characters,
  // whatever the worker writes.
  Image render(const PictureRequest& request);
  bool is_usable() const { return usable_; }

 private:
  std::string context(const std::string& shown) const;
  // Sends a line and waits for the answer to it.
  std::string ask(const std::string& line, const std::string& shown);
  std::string next_answer(const std::string& shown);
  // Returns the message of an error: the place, and what is wrong. If the error is about a file, also says
  // what to do.
  std::string message_of(const std::string& shown, const std::string& what) const;
  // Ends the process and returns a message with the end of its log.
  std::string ended(const std::string& shown, const std::string& what);
  [[noreturn]] void fail(const std::string& shown, const std::string& what);
  std::filesystem::path own_file(const std::string& ending) const;
  Image read_picture(const PictureRequest& request, const std::filesystem::path& path);

  const WorkerEntry entry_;
  const WorkerSettings settings_;
  const std::filesystem::path files_;
  std::unique_ptr<ChildProcess> process_;
  WorkerDescription description_;
  std::int64_t last_id_ = 0;
  bool has_answered_ = false;
  bool usable_ = false;
};

}  // namespace remap
