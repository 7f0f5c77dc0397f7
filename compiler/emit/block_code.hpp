// The part of a generated header between the mapping and the rows of texels: domain rule and loops.
#pragma once

#include <string>

#include "emit/mapping_code.hpp"
#include "remap/fit.hpp"

namespace remapc {

// Functions of namespace detail: held_width(), channel_outside(), and convert_block(), which converts up to
// kBlock texels by the functions of `code`; Mapping and Block, which it takes.
std::string block_code(const remap::Fit& fit, const MappingCode& code);

}  // namespace remapc
