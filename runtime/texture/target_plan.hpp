// Plans the files of a conversion and the content of their channels, and refuses to overwrite inputs.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "remap/model.hpp"
#include "texture/layout.hpp"
#include "texture/texture_pass.hpp"

namespace remap {

struct PlannedMap {
  std::filesystem::path path;
  std::vector<TargetPart> parts;
};

// A file of the material that is not converted but copied, byte for byte unless its green is turned.
struct CopiedFile {
  std::filesystem::path source;
  // Of the copy, without extension, in layouts that name their files; empty to keep the name of the file.
  std::string name;
  // The name of the copy of a normal map whose green channel is inverted.
  std::string turned_name;
};
struct PlannedCopy {
  std::filesystem::path source;
  std::filesystem::path path;
  std::vector<TargetPart>
      parts;  // of a result that repeats the source; empty for files that are not converted
  bool turns_green = false;
};

struct TargetPlan {
  std::vector<PlannedMap> maps;
  std::vector<PlannedCopy> copies;
  std::vector<std::string>
      unplaced;  // a message for each channel of the inputs without a place in the layout
};

// Integers store 0 to 1, but exponents are larger. Throws kUsage if an integer result would hold roughness as
// an exponent.
void require_target_scale(const TextureSet& set, const TargetPlan& plan);

// Text before and after the names of results without an input: `wood` specular `.1001`.
struct ResultNames {
  std::string set;
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
  std::string extension;                 // of all files; empty for those of the inputs
  std::optional<PixelType> type;         // of all files
  std::optional<int> compression_level;  // of all files that take one
  ResultNames names;
  Layout layout = as_inputs();
  // Whose stored values stay as they are. A result that would repeat a file is a copy of it.
  std::vector<Parameter> unchanged;
  std::vector<CopiedFile> copies;
  Metadata metadata;
};

// The extension of a result that follows `input`: WebP is written as PNG.
std::string written_extension(const std::filesystem::path& input);

// The name of the file that holds a parameter in layouts that name their files, or without an input of the
// same name; without extension.
std::string file_name(Parameter parameter, const TargetChoice& choice, const ResultNames& names);
// The name of the map of a diagnosis, without extension: `wood_mask`, `wood_residual`.
std::string diagnosis_name(const TargetChannel& diagnosis, const ResultNames& names);

// Plans the files of a conversion.
//
// As inputs: each map with a converted channel becomes a file of its name in which only converted channels
// change; a grey color becomes three channels if the result is not grey. A constant becomes a separate map
// (`roughness`, `specular`), and files of carried parameters are copied. A parameter that is not in the set
// has no place: kUsage. The other layouts name their files. What has no channel in the layout has a separate
// file, coverage becomes the alpha of diffuse or base color, and channels without a meaning are left out.
//
// Throws kUsage if two results have the same name, a result is an input, a channel has two meanings, the
// layout has no place for a constant, and for an unknown extension; kInput if a file to copy does not exist;
// kOutput if the folder is a file. Results may exist.
TargetPlan plan_targets(const TextureSet& set, const TargetChoice& choice);

// Opens the planned files. Throws kOutput if a folder cannot be created or a file cannot be opened.
std::vector<TargetMap> open_targets(const TextureSet& set, const TargetPlan& plan);

}  // namespace remap
