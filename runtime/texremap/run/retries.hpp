// This file repeats work after failures that are soon over, for example if a file server does not answer.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace remap {

// Calls `work`. If it fails with a code of a short failure (core/errors.hpp), calls it up to three times
// again, with growing pauses. Returns the messages of the failures before the success. If all calls fail,
// throws the last failure. An interruption ends the pause.
std::vector<std::string> with_retries(const std::function<void()>& work);

}  // namespace remap
