// This file handles `--converters`, the converters of a run.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "command_line/command.hpp"
#include "paths/converter_file.hpp"
#include "remap/path.hpp"

namespace remap {

// A UsedConverters holds the shipped converters, or the converters of --converters. It reads this file or
// folder only once.
class UsedConverters {
 public:
  // Adds the option, which every command has. The object must live until the command has run.
  Option* add_option(Command& command);
  // Returns the graph of the converters, which must not outlive this object. Throws kInput if a converter
  // cannot be read.
  ConverterGraph graph(InstructionSet set = best_instruction_set()) const;
  // Returns the fit if the option names the file of one fit, which also names its models.
  std::optional<FittedConverter> fit() const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;  // if empty, the shipped converters are used
  mutable std::map<InstructionSet, std::shared_ptr<const ConverterList>> read_;
};

}  // namespace remap
