// What a test program does before its first case, when it has no thread, handler or open file of its own.
#pragma once

namespace remap {

void before_cases(void (*work)());

}  // namespace remap
