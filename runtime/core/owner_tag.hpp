// This file marks the files that a process leaves on disk while it works. Other processes can then see which
// of these files nobody needs any more.
#pragma once

#include <string>
#include <string_view>

namespace remap {

// Returns `TAG-PID` of this process. The tag is eight hexadecimal digits. They identify the machine since its
// start, and its PID namespace, which differs between containers.
std::string owner_tag();

// Returns random letters from the system, for file names that nobody can guess in advance.
std::string random_letters();

// Returns true if `mark` belongs to a process of this machine and namespace that has ended. Returns false for
// other texts. Also returns false for a mark of another machine, because nobody can check it. If a new
// process has the same number, the mark is treated as alive until that process ends, too.
bool is_stale_owner(std::string_view mark);

}  // namespace remap
