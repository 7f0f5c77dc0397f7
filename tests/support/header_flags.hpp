// Generated headers compile without warnings under these flags.
#pragma once

inline constexpr const char* kHeaderFlags =
    " -fno-exceptions -fno-rtti -Wall -Wextra -Wshadow -Wconversion -Wsign-conversion -Wpedantic -Werror ";
