// This file holds what the fuzz targets share. A function under test gets any bytes. It reads them, or
// refuses them with an Error whose message is short and safe for a terminal. Anything else ends the run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/plain_text.hpp"
#include "remap/error.hpp"

namespace remap {

// print_message() (command_line/run_app.hpp) shows at most this many bytes.
inline constexpr std::size_t kLongestRefusal = 8000;

template <typename Read>
int read_or_refuse(Read read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string_view message = error.what();
    if (message.size() > kLongestRefusal || !is_plain_text(message)) std::abort();
  }
  return 0;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace remap
