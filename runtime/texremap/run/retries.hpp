// This file repeats work after failures that pass soon, such as a file server that does not answer.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace remap {

// Does `work`. If it fails with a code that passes soon (core/errors.hpp), repeats it up to three times with
// growing pauses. Returns the messages of the failures before the success, and throws the last one. An
// interruption ends the pause.
std::vector<std::string> with_retries(const std::function<void()>& work);

}  // namespace remap
