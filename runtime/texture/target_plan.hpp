// This file plans the files of a conversion and their channels, and refuses to overwrite inputs.
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

// A PlannedFile is a result. A copy has a source. It has parts if the conversion would repeat the source, and
// no parts if the source is not converted.
struct PlannedFile {
  std::filesystem::path path;
  std::vector<TargetPart> parts;
  std::filesystem::path source = {};
  bool turns_green = false;
};

// A CopiedFile is a file of the material that is copied, not converted. It is copied byte for byte unless its
// green is inverted.
struct CopiedFile {
  std::filesystem::path source;
  // This is the name of the copy, without extension, in layouts with named files. If it is empty, the copy
  // keeps the name of the file.
  std::string name;
  // This is the name of the copy of a normal map with inverted green.
  std::string turned_name;
  std::string reason = {};  // why green is inverted, or kept although nothing is known; or empty
};
struct TargetPlan {
  std::vector<PlannedFile> maps;
  std::vector<PlannedFile> copies;
  std::vector<std::string> unplaced;  // a message for each input channel without a place in the layout
};

// Throws kUsage if a result with integers would hold roughness as an exponent, because integers store 0 to 1,
// and exponents are larger.
void require_target_scale(const TextureSet& set, const TargetPlan& plan);

// A ResultNames holds the text before and after a parameter in the name of a result that has no input of the
// same name. For `wood_specular.1001`, these are `wood` and `.1001`.
struct ResultNames {
  std::string set;
  std::string after;
};

struct TargetChoice {
  MapTreatment treatment;  // its encoding of roughness is the one that the user chose
  std::filesystem::path folder;
  std::vector<Parameter> parameters = {Parameter::kRoughness, Parameter::kSpecular};  // parameters to write
  std::string width_name = "roughness";           // name of a separate roughness file
  std::map<Parameter, Transfer> color_transfers;  // transfer curves that the user chose
  bool colors_stay_grey = true;                   // if grey in the set, a color in a separate file stays grey
  std::vector<TargetChannel> diagnoses;           // mask and measures, each a grey map in diagnosis_folder
  std::filesystem::path diagnosis_folder;
  std::string extension;                 // extension of all files; if empty, as the inputs
  std::optional<PixelType> type;         // type of all files
  std::optional<int> compression_level;  // for all files whose compression has levels
  ResultNames names;
  Layout layout = as_inputs();
  // These parameters keep their stored values. A result that would equal an input file becomes a copy of this
  // file.
  std::vector<Parameter> unchanged;
  // These parameters have values that integers cannot hold, so new files of them are EXR.
  std::vector<Parameter> wide;
  std::vector<CopiedFile> copies;
  Metadata metadata;
};

// Returns the extension of a result that is made from `input`. A result from WebP is PNG.
std::string written_extension(const std::filesystem::path& input);

// Returns the name, without extension, of the file that holds a parameter. This is for layouts with named
// files, and for results without an input of the same name.
std::string file_name(Parameter parameter, const TargetChoice& choice, const ResultNames& names);
// Returns the name of a diagnosis map, without extension: `wood_mask`, `wood_residual`.
std::string diagnosis_name(const TargetChannel& diagnosis, const ResultNames& names);

// Plans the files of a conversion.
//
// Layout as-inputs: each map with a converted channel becomes a file of its name in which only converted
// channels change. A grey color becomes three channels if the result is not grey. A constant becomes a
// separate map (`roughness`, `specular`), and files of carried parameters are copied. A parameter that is not
// in the set has no place: kUsage. The other layouts name their files. A parameter without a channel in the
// layout has a separate file. Coverage becomes the alpha of diffuse or base color, and channels without a
// meaning are skipped.
//
// Throws kUsage if two results have the same name, a result is an input, or a channel has two meanings. Also
// throws kUsage if the layout has no place for a constant, and for an unknown extension. Throws kInput if a
// file to copy does not exist, and kOutput if the folder is a file. Results may exist.
TargetPlan plan_targets(const TextureSet& set, const TargetChoice& choice);

// Opens the planned files. Throws kOutput if a folder cannot be created or a file cannot be opened.
std::vector<TargetMap> open_targets(const TextureSet& set, const TargetPlan& plan);

}  // namespace remap
