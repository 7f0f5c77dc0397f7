// `--converters`, which every command of texremap takes.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "convert/shipped_converters.hpp"

namespace remap {

inline void add_converters_option(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--converters", [](const std::string& path) { use_converters(path); },
          "Converters to use in place of the shipped ones: converters.json of `remapc emit --all`, a fit, or "
          "a folder "
          "of fits")
      ->envname("REMAP_CONVERTERS")
      ->trigger_on_parse();
}

}  // namespace remap
