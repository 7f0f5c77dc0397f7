// This file runs jobs in separate processes. If a hostile image crashes a decoder, only one job is lost.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace remap {

// Makes run_apart() work in copies of this process from now on. Only programs call it. A host of the commands
// has its own threads and memory, so its jobs stay in threads.
void use_job_processes();

struct ApartJobs {
  std::size_t count = 0;
  unsigned at_once = 0;  // 0: one per processor
  // Does job `i` in another process or thread, and returns its result (packed_values.hpp). `advance` reports
  // the finished fraction of the job, from 0 to 1, to this process.
  std::function<std::string(std::size_t i, const std::function<void(double)>& advance)> work;
  // These functions are called in this process, one call at a time.
  std::function<void(std::size_t i, double share)> advanced = [](std::size_t, double) {};
  std::function<void(std::size_t i, std::string result)> finished;
  // Is called when the process of the job was ended and has left unfinished files.
  std::function<void(std::size_t i)> clean = [](std::size_t) {};
  // Is called when the process was ended for `reason` and the job is not tried again.
  std::function<void(std::size_t i, const std::string& reason)> crashed;
};

// Does all jobs. The first Error stops the jobs that have not begun, and is thrown here.
void run_apart(const ApartJobs& jobs);

}  // namespace remap
