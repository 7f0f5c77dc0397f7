// The flags that generated headers are clean under.
#pragma once

inline constexpr const char* kHeaderFlags =
    " -fno-exceptions -fno-rtti -Wall -Wextra -Wshadow -Wconversion -Wsign-conversion -Wpedantic -Werror ";
