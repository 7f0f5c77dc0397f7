// `--converters`, an option of every command of texremap.
#pragma once

#include <string>

#include "command_line/command.hpp"
#include "remap/shipped_converters.hpp"

namespace remap {

inline void add_converters_option(Command& command) {
  command
      .add_action(
          "--converters", [](const std::string& path) { use_converters(path); },
          "Use these converters instead of the shipped ones: a converters.json of `remapc emit "
          "--all`, a fit, or a folder of fits")
      ->type_name("PATH")
      ->environment("REMAP_CONVERTERS");
}

}  // namespace remap
