// Jobs in processes of their own. What a decoder of images does with a hostile file, crash or loop, costs one
// job.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace remap {

// From now on run_apart() works in copies of this process. For programs; a host of the commands has threads
// and memory of its own, and its jobs stay in threads.
void use_job_processes();

struct ApartJobs {
  std::size_t count = 0;
  unsigned at_once = 0;  // 0: one a processor
  // Does job `i` and returns what is to be known of it (packed_values.hpp). In another process or thread;
  // `advance` tells this one what share of the job is done, from 0 to 1.
  std::function<std::string(std::size_t i, const std::function<void(double)>& advance)> work;
  // The rest is called in this process, one call at a time.
  std::function<void(std::size_t i, double share)> advanced = [](std::size_t, double) {};
  std::function<void(std::size_t i, std::string result)> finished;
  // The process of the job was ended, and has left unfinished files.
  std::function<void(std::size_t i)> clean = [](std::size_t) {};
  // So it was, as `reason` says, and the job is not tried again.
  std::function<void(std::size_t i, const std::string& reason)> crashed;
};

// Works through all jobs. The first Error of one stops those that have not begun, and is thrown here.
void run_apart(const ApartJobs& jobs);

}  // namespace remap
