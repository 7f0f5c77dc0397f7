// This file includes generated/converters.json with the assembler, because a string literal would take the
// compiler seconds.
#include "paths/shipped_text.hpp"

extern "C" {
extern const char remap_shipped_text_begin[];
extern const char remap_shipped_text_end[];
}

#define REMAP_TEXT_OF(name) #name
#define REMAP_TEXT(name) REMAP_TEXT_OF(name)
// Makes the name that the assembler uses for a C name.
#define REMAP_SYMBOL(name) REMAP_TEXT(__USER_LABEL_PREFIX__) #name
#define REMAP_LABEL(name) ".globl " REMAP_SYMBOL(name) "\n" REMAP_SYMBOL(name) ":\n"
// Linkers for WebAssembly need the size of data.
#define REMAP_SIZE(name, size) ""

#if defined(_WIN32)
#define REMAP_ENTER_CONSTANTS ".section .rdata,\"dr\"\n"
#define REMAP_LEAVE_CONSTANTS ".text\n"
#elif defined(__APPLE__)
#define REMAP_ENTER_CONSTANTS ".const\n"
#define REMAP_LEAVE_CONSTANTS ".text\n"
#elif defined(__wasm__)
#define REMAP_ENTER_CONSTANTS ".section .rodata.remap_shipped_text,\"\",@\n"
#define REMAP_LEAVE_CONSTANTS ".text\n"
#undef REMAP_SIZE
#define REMAP_SIZE(name, size) ".type " #name ",@object\n.size " #name "," size "\n"
#else
#define REMAP_ENTER_CONSTANTS ".pushsection .rodata\n"
#define REMAP_LEAVE_CONSTANTS ".popsection\n"
#endif

// clang-format off
__asm__(REMAP_ENTER_CONSTANTS
        REMAP_LABEL(remap_shipped_text_begin)
        ".incbin \"" REMAP_CONVERTERS_FILE "\"\n"
        REMAP_LABEL(remap_shipped_text_end)
        ".byte 0\n"
        REMAP_SIZE(remap_shipped_text_begin, "remap_shipped_text_end-remap_shipped_text_begin")
        REMAP_SIZE(remap_shipped_text_end, "1")
        REMAP_LEAVE_CONSTANTS);
// clang-format on

namespace remap {

std::string_view shipped_text() noexcept {
  return {remap_shipped_text_begin,
          static_cast<std::size_t>(remap_shipped_text_end - remap_shipped_text_begin)};
}

}  // namespace remap
