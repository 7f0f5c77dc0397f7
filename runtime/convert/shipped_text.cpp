// The assembler copies the file: as a string literal it would take the compiler seconds.
#include "convert/shipped_text.hpp"

extern "C" {
extern const char remap_shipped_text_begin[];
extern const char remap_shipped_text_end[];
}

__asm__(
    ".pushsection .rodata\n"
    ".global remap_shipped_text_begin\n"
    "remap_shipped_text_begin:\n"
    ".incbin \"" REMAP_CONVERTERS_FILE
    "\"\n"
    ".global remap_shipped_text_end\n"
    "remap_shipped_text_end:\n"
    ".byte 0\n"
    ".popsection\n");

namespace remap {

std::string_view shipped_text() noexcept {
  return {remap_shipped_text_begin,
          static_cast<std::size_t>(remap_shipped_text_end - remap_shipped_text_begin)};
}

}  // namespace remap
