// This file translates the options of `texremap convert` into requests of the texture library.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "texremap/options/convert_options.hpp"
#include "texture/target_plan.hpp"

namespace remap {

// Each function throws kUsage, with the option, for an invalid value.
TextureSetRequest set_request(const ConvertOptions& options, const ConversionChoice& workflow);
// Returns an option that reads one channel of the map, such as `--roughness '*_rough.jpg:G'`. Returns an
// empty text if `file` is empty.
std::string one_channel(const std::string& option, const std::filesystem::path& file);
// Returns the files to copy if the options name one set.
std::vector<CopiedFile> copied_files(const ConvertOptions& options, const ConversionChoice& workflow);
// Returns the copy of a normal map in a folder. The direction of green comes from the name of the map,
// otherwise from the source model. If the target has the other direction, the copy has inverted green, unless
// the folder already has a map with that direction.
CopiedFile copied_normals(const ConvertOptions& options, const std::filesystem::path& source);
// Returns the file that an option gives for every set of a folder: the given path, or a path below the
// folder. Returns nothing for a pattern and for a name in the folders of sets.
std::optional<std::filesystem::path> shared_map(const ConvertOptions& options,
                                                const std::filesystem::path& given);
// Returns the files that shared_map() finds for all options. Returns none if the source is not a folder.
std::vector<std::filesystem::path> shared_maps(const ConvertOptions& options);
TargetChoice target_choice(const ConvertOptions& options, const ConversionChoice& workflow);
// Returns what a translation makes of a set, or nothing for other conversions.
std::optional<TranslationEffect> effect_of(const ConversionChoice& workflow,
                                           const TextureSetRequest& request);
// Sets the parameters that a set's translation writes, and those that it keeps.
void apply(const TranslationEffect& effect, TargetChoice& choice);
// Returns the encoding of a set's roughness results: --output-encoding, or `usual` without this option. Names
// stay true. A glossiness map that keeps its name stays glossiness, orm and arm hold roughness, and specgloss
// holds glossiness. Throws kUsage if --output-encoding contradicts such a name.
RoughnessEncoding written_width(const TargetChoice& choice, const TextureSet& set, RoughnessEncoding usual);

}  // namespace remap
