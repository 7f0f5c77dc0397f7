// What a resumed run compares: hashes of a conversion and of the inputs of a set.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

// A hash of the files of a set, and of what is taken from where.
std::string inputs_hash(const std::vector<std::filesystem::path>& files, const ConversionJob& job);

}  // namespace remap
