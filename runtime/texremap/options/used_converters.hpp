// `--converters`: the converters of a run.
#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "command_line/command.hpp"
#include "remap/path.hpp"

namespace remap {

// The shipped converters, or those of a file or folder that --converters names, read once.
class UsedConverters {
 public:
  // Adds the option, which every command has. The object must live until the command has run.
  Option* add_option(Command& command);
  // The graph of the converters, which lives no longer than this object. Throws kInput where they cannot be
  // read.
  ConverterGraph graph(InstructionSet set = best_instruction_set()) const;

 private:
  std::filesystem::path path_;  // empty: the shipped ones
  mutable std::map<InstructionSet, std::shared_ptr<const ConverterList>> read_;
};

}  // namespace remap
