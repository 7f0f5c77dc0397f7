// This file marks the files that a process leaves on disk while it works. Other processes can then see which
// of these files are no longer needed.
#pragma once

#include <string>
#include <string_view>

namespace remap {

// Returns `TAG-PID` of this process. The tag has eight hexadecimal digits. They identify the machine since it
// was started, and the PID namespace, which differs between containers.
std::string owner_tag();

// Returns random letters from the system, for file names that nobody can guess in advance.
std::string random_letters();

// Returns true if `mark` is of a process of this machine and namespace that has ended. Returns false for
// other texts, and for a mark of another machine, because this machine cannot check it. If a new process has
// the same number, returns false until this process has ended, too.
bool is_stale_owner(std::string_view mark);

}  // namespace remap
