// Plans the files of a conversion and the content of their channels, and refuses to overwrite other files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "remap/model.hpp"
#include "texture/texture_pass.hpp"

namespace remap {

struct PlannedMap {
  std::filesystem::path path;
  std::vector<TargetPart> parts;
};

// A file of the material that is not converted but copied byte for byte.
struct CopiedFile {
  std::filesystem::path source;
  // Of the copy, without extension, in layouts that name their files; empty to keep the name of the file.
  std::string name;
};
struct PlannedCopy {
  std::filesystem::path source;
  std::filesystem::path path;
};

struct TargetPlan {
  std::vector<PlannedMap> maps;
  std::vector<PlannedCopy> copies;
};

// The arrangement of the results in files.
enum class Layout {
  kAsInputs,   // each map with a converted channel keeps its name
  kSeparate,   // one file each for roughness, colors and carried parameters
  kOrm,        // orm: occlusion, roughness, metallic; and one file per color
  kArm,        // like kOrm, named arm
  kSpecGloss,  // specular_glossiness: specular, with glossiness in alpha; and diffuse
};
inline constexpr NamedValues<Layout, 5> kLayouts = {{{Layout::kAsInputs, "as-inputs"},
                                                     {Layout::kSeparate, "separate"},
                                                     {Layout::kOrm, "orm"},
                                                     {Layout::kArm, "arm"},
                                                     {Layout::kSpecGloss, "specgloss"}}};

// Text before and after the names of results without an input: `wood_` specular `.1001`.
struct ResultNames {
  std::string before;
  std::string after;
};

struct TargetChoice {
  std::filesystem::path folder;
  std::vector<Parameter> parameters = {Parameter::kRoughness, Parameter::kSpecular};  // to write
  std::string width_name = "roughness";           // name of a separate roughness file
  std::map<Parameter, Transfer> color_transfers;  // chosen by the user
  bool colors_stay_grey = true;          // colors that are grey in the set stay grey in a separate file
  std::vector<TargetChannel> diagnoses;  // the mask and measures: a grey map each, in a folder of its own
  std::filesystem::path diagnosis_folder;
  std::string extension;          // of all files; empty for those of the inputs
  std::optional<PixelType> type;  // of all files
  ResultNames names;
  Layout layout = Layout::kAsInputs;
  std::vector<CopiedFile> copies;
  bool force = false;  // may overwrite existing files
  Metadata metadata;
};

// The name of the file that holds a parameter in layouts that name their files, or without an input of the
// same name; without ResultNames and extension.
std::string file_name(Parameter parameter, const TargetChoice& choice);
// The name of the map of a diagnosis, without ResultNames and extension: `mask`, `residual`.
std::string diagnosis_name(const TargetChannel& diagnosis);

// Plans the files of a conversion.
//
// kAsInputs: each map with a converted channel becomes a file of its name in which only converted channels
// change; a grey color becomes three channels if the result is not grey. A constant becomes a separate map
// (`roughness`, `specular`), and files of carried parameters are copied. A parameter that is not in the set
// has no place: kUsage. The other layouts name their files. Carried parameters without a channel in the
// layout have a separate file, and coverage becomes the alpha of diffuse or base color.
//
// Throws kUsage if two results have the same name, a result is an input, a channel has two meanings, the
// layout would lose a channel or has no place for a constant, and for an unknown extension; kInput if a file
// to copy does not exist; kOutput if a result exists and `force` is not set, or if the folder is a file.
TargetPlan plan_targets(const TextureSet& set, const TargetChoice& choice);

// Opens the planned files. Throws kOutput if a folder cannot be created or a file cannot be opened.
std::vector<TargetMap> open_targets(const TextureSet& set, const TargetPlan& plan);

}  // namespace remap
