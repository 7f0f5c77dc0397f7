// This file runs work on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace remap {

// Runs `work(i)` for each i below `count` on `jobs` threads. If `jobs` is 0, uses one thread for each
// processor. The first exception stops the remaining work and is thrown to the caller.
void run_parallel(std::size_t count, unsigned jobs, const std::function<void(std::size_t)>& work);

}  // namespace remap
