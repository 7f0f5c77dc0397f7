// This file lists the names of error kinds, for hosts in other languages.
#pragma once

#include "remap/error.hpp"
#include "remap/model.hpp"

namespace remap {

inline constexpr NamedValues<ErrorKind, 5> kErrorKinds = {{{ErrorKind::kUsage, "usage"},
                                                           {ErrorKind::kInput, "input"},
                                                           {ErrorKind::kOutput, "output"},
                                                           {ErrorKind::kNumeric, "numeric"},
                                                           {ErrorKind::kInterrupted, "interrupted"}}};

}  // namespace remap
