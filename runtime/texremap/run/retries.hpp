// Work that is done again after failures that pass soon, such as a server of files that does not answer.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace remap {

// Does `work`, up to three times again, longer apart from time to time, where it fails with a code that
// passes soon (core/errors.hpp). Returns the messages of the failures before it succeeded; throws the last
// one. An interruption ends the waiting.
std::vector<std::string> with_retries(const std::function<void()>& work);

}  // namespace remap
