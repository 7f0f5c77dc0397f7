#include "texremap/run/job_processes.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "command_line/progress.hpp"
#include "core/packed_values.hpp"
#include "core/parallel.hpp"
#include "core/system.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

std::atomic<bool> uses_processes = false;

// An Answer is a message from a copied process about its job.
struct Answer {
  enum class Kind { kShare, kResult, kError } kind = Kind::kShare;
  double share = 0.0;
  std::string text;  // the result, or the text of an error
  ErrorKind error = ErrorKind::kInput;
  int system_code = 0;
};

template <typename Archive>
void fields(Archive& archive, Answer& answer) {
  archive(answer.kind, answer.share, answer.text, answer.error, answer.system_code);
}

// Sends a message after its size.
bool send_message(int descriptor, const std::string& message) {
  const std::uint64_t size = message.size();
  return send_all(descriptor, std::string(reinterpret_cast<const char*>(&size), sizeof size) + message);
}

// A Messages collects bytes of a stream and returns whole messages.
class Messages {
 public:
  // Waits for bytes and reads them. Returns false at the end of the stream.
  bool read(int descriptor) {
    std::array<char, 1 << 16> piece;
    std::ptrdiff_t count = 0;
    do count = read_on(descriptor, piece.data(), piece.size());
    while (count < 0 && errno == EINTR);
    if (count <= 0) return false;
    bytes_.append(piece.data(), static_cast<std::size_t>(count));
    return true;
  }
  std::optional<std::string> next() {
    std::uint64_t size = 0;
    if (bytes_.size() < sizeof size) return std::nullopt;
    std::memcpy(&size, bytes_.data(), sizeof size);
    if (bytes_.size() - sizeof size < size) return std::nullopt;
    std::string message = bytes_.substr(sizeof size, static_cast<std::size_t>(size));
    bytes_.erase(0, sizeof size + static_cast<std::size_t>(size));
    return message;
  }

 private:
  std::string bytes_;
};

// Runs in a copied process. Does one job after another until the main process closes the stream.
void serve(int descriptor, const ApartJobs& jobs) {
  Messages requests;
  for (;;) {
    std::optional<std::string> request;
    while (!(request = requests.next()))
      if (!requests.read(descriptor)) return;
    Answer answer;
    try {
      const auto advance = [&](double share) {
        (void)send_message(descriptor, packed(Answer{Answer::Kind::kShare, share, "", ErrorKind::kInput, 0}));
      };
      answer.text = jobs.work(unpacked<std::size_t>(*request), advance);
      answer.kind = Answer::Kind::kResult;
    } catch (const Error& error) {
      answer = {Answer::Kind::kError, 0.0, error.what(), error.kind(), error.system_code()};
    }
    if (!send_message(descriptor, packed(answer))) return;
  }
}

// A Copies holds the copied processes of a run, and their current jobs.
class Copies {
 public:
  Copies(const ApartJobs& jobs, std::size_t most) : jobs_(jobs), copies_(most) {}
  ~Copies() {
    for (Copy& copy : copies_)
      if (copy.process) (void)end_of(*copy.process);
  }
  Copies(const Copies&) = delete;
  Copies& operator=(const Copies&) = delete;

  // Returns false if the system cannot copy processes.
  bool run() {
    for (;;) {
      for (Copy& copy : copies_)
        if (!copy.job && has_more() && !failure_ && !give(copy)) return false;
      std::vector<int> descriptors;
      for (const Copy& copy : copies_) descriptors.push_back(copy.job ? copy.process->descriptor : -1);
      if (std::ranges::all_of(descriptors, [](int descriptor) { return descriptor < 0; })) break;
      if (interruption() && !is_stopping_) {
        is_stopping_ = true;
        for (const Copy& copy : copies_)
          if (copy.process) interrupt(*copy.process);
      }
      const std::vector<bool> readable = wait_to_read(descriptors);
      for (std::size_t i = 0; i < copies_.size(); ++i)
        if (readable[i]) hear(copies_[i]);
    }
    if (failure_) throw *failure_;
    return true;
  }

 private:
  struct Copy {
    std::optional<ProcessCopy> process;
    Messages messages;
    std::optional<std::size_t> job;
  };

  bool has_more() const { return next_ < jobs_.count || !again_.empty(); }

  bool give(Copy& copy) {
    if (!copy.process) {
      copy.messages = {};
      copy.process = copy_process([this](int descriptor) { serve(descriptor, jobs_); });
    }
    if (!copy.process) return false;
    copy.job = again_.empty() ? next_++ : again_.back();
    if (!again_.empty()) again_.pop_back();
    (void)send_message(copy.process->descriptor, packed(*copy.job));  // hear() notices an ended process
    return true;
  }

  void hear(Copy& copy) {
    const bool goes_on = copy.messages.read(copy.process->descriptor);
    while (const std::optional<std::string> message = copy.messages.next())
      take(copy, unpacked<Answer>(*message));
    if (goes_on) return;
    const std::string how = end_of(*copy.process);
    copy.process.reset();
    if (!copy.job) return;
    const std::size_t job = *copy.job;
    copy.job.reset();
    // Signal 9 comes from the system if memory runs out, otherwise from a person.
    jobs_.clean(job);
    const bool is_killed = how.starts_with("by signal 9 ");
    if (is_killed && ++kills_[job] < kMostTries) return again_.push_back(job);
    jobs_.crashed(job, "the process that converted these files was ended " + how +
                           (is_killed ? ", probably because memory ran out (use fewer --threads)"
                                      : ", probably by a damaged image (write their images again as PNG)"));
  }

  void take(Copy& copy, Answer answer) {
    if (answer.kind == Answer::Kind::kShare) return jobs_.advanced(*copy.job, answer.share);
    const std::size_t job = *copy.job;
    copy.job.reset();
    if (answer.kind == Answer::Kind::kResult) return jobs_.finished(job, std::move(answer.text));
    if (!failure_) failure_.emplace(answer.error, answer.text, answer.system_code);
  }

  const ApartJobs& jobs_;
  std::vector<Copy> copies_;
  std::size_t next_ = 0;
  static constexpr int kMostTries = 3;
  std::vector<std::size_t> again_;    // jobs whose process was killed
  std::map<std::size_t, int> kills_;  // number of kills, by job
  std::optional<Error> failure_;
  bool is_stopping_ = false;
};

void run_in_threads(const ApartJobs& jobs) {
  std::mutex mutex;
  run_parallel(jobs.count, jobs.at_once, [&](std::size_t i) {
    const auto advance = [&](double share) {
      const std::lock_guard lock(mutex);
      jobs.advanced(i, share);
    };
    std::string result = jobs.work(i, advance);
    const std::lock_guard lock(mutex);
    jobs.finished(i, std::move(result));
  });
}

}  // namespace

void use_job_processes() { uses_processes = true; }

void run_apart(const ApartJobs& jobs) {
  const std::size_t wanted =
      jobs.at_once == 0 ? std::max(1u, std::thread::hardware_concurrency()) : jobs.at_once;
  if (!uses_processes || !Copies(jobs, std::min(wanted, jobs.count)).run()) run_in_threads(jobs);
}

}  // namespace remap
