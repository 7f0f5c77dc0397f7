// Translates the options of `texremap convert` into requests of the texture library.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "texremap/options/convert_options.hpp"
#include "texremap/plan/workflow_choice.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_pass.hpp"

namespace remap {

// Each function throws kUsage, naming the option, for an invalid value.
TextureSetRequest set_request(const ConvertOptions& options, const WorkflowChoice& workflow);
// The option that takes one channel of a map: `--roughness '*_rough.jpg:G'`; empty without a file.
std::string one_channel(const std::string& option, const std::filesystem::path& file);
// The files to copy with the one set that the options name.
std::vector<CopiedFile> copied_files(const ConvertOptions& options, const WorkflowChoice& workflow);
// The copy of a normal map of a folder. Green is inverted where it points another way than the target reads
// it, unless the folder has that map as well. The name of the map says where green points, else the source
// does.
struct CopiedNormals {
  CopiedFile copy;
  std::string reason;  // why green is inverted, or kept although nothing is known; else empty
};
CopiedNormals copied_normals(const ConvertOptions& options, const std::filesystem::path& source);
// The file that an option gives for every set of a folder: the path as given, or below the folder; none for a
// pattern and for a name in the folders of sets.
std::optional<std::filesystem::path> shared_map(const ConvertOptions& options,
                                                const std::filesystem::path& given);
// All of them.
std::vector<std::filesystem::path> shared_maps(const ConvertOptions& options);
TargetChoice target_choice(const ConvertOptions& options, const WorkflowChoice& workflow);
// The roughness of a set before the conversion.
struct WidthSource {
  std::filesystem::path file;                   // empty for a number
  std::optional<RoughnessEncoding> convention;  // where an option or the name of the file says it
};
// What the roughness results of a set hold: `usual`, or what --output-encoding asks for, but what a name says
// stays true: a map of glossiness that keeps its name stays glossiness, orm and arm hold roughness, specgloss
// holds glossiness. Throws kUsage if --output-encoding contradicts a name that stays.
RoughnessEncoding written_width(std::optional<RoughnessEncoding> asked, const TargetChoice& choice,
                                const WidthSource& source, RoughnessEncoding usual);
// Refuses --exponent-of-white for results that hold no exponent.
void require_factor_of_exponent(bool is_given, RoughnessEncoding width);

PassOptions pass_options(const ConvertOptions& options);

}  // namespace remap
