// Marks what a process leaves on disk while it works, so that another one can tell what nobody needs any
// more.
#pragma once

#include <string>
#include <string_view>

namespace remap {

// `TAG-PID` of this process. The tag is eight hexadecimal digits that stand for the machine since it was
// started and its space of process numbers, which differs from one container to the next.
std::string owner_tag();

// Letters of the system's random numbers, for names that nobody can know before they are there.
std::string random_letters();

// Returns whether `mark` names a process of this machine and namespace that has ended. Returns false for
// every other text, and for a mark of another machine, because nobody can check it. If a new process has the
// same number, the mark is treated as alive until that process ends, too.
bool is_stale_owner(std::string_view mark);

}  // namespace remap
