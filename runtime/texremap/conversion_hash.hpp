// What a resumed run compares: hashes of a conversion and of the inputs of a set.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/input_file.hpp"
#include "texremap/conversion_jobs.hpp"
#include "texremap/convert_report.hpp"
#include "texremap/journal.hpp"

namespace remap {

// Everything besides the inputs that results depend on. The converter is hashed by what it makes of texels
// all over its domain: its numbers and its code.
ConversionNote conversion_note(const ChosenConverter& chosen, const ConvertOptions& options);
// Of assets, whose materials go through `converter`.
ConversionNote conversion_note(const std::string& source, const std::string& target,
                               const Converter& converter, const ConvertOptions& options);

// Files that are open, each once.
using OpenFiles = std::vector<std::shared_ptr<const InputFile>>;

// A hash of the files of a set, of what is taken from where, and of the files that are copied beside it.
std::string inputs_hash(const OpenFiles& files, const ConversionJob& job, const OpenFiles& copied);

}  // namespace remap
