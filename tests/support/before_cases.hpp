// This file runs work before the first case of a test program, while it has no thread, handler or open file.
#pragma once

namespace remap {

void before_cases(void (*work)());

}  // namespace remap
