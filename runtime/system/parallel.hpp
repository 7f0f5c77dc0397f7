// Work on all processors.
#pragma once

#include <cstddef>
#include <functional>

namespace remap {

// Runs `work(i)` for each i below `count` on `jobs` threads (0: one a processor); the first exception stops
// the rest and is thrown here.
void run_parallel(std::size_t count, unsigned jobs, const std::function<void(std::size_t)>& work);

}  // namespace remap
