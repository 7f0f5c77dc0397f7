// What the fuzz targets share. A reader takes any bytes: it reads them, or refuses them with an Error whose
// message is short and fit for a terminal. Anything else ends the run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/plain_text.hpp"
#include "remap/error.hpp"

namespace remap {

// What print_message() (command_line/run_app.hpp) shows at most.
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
