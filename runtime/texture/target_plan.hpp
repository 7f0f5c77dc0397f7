// Which files a conversion makes, what their channels hold, and the refusals that keep other files safe.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "texture/texture_pass.hpp"

namespace remap {

// A result before it is opened.
struct PlannedPart {
  std::size_t model = 0;  // the map of the set that it follows
  ImageChanges changes;
  std::vector<TargetChannel> channels;
};
struct PlannedMap {
  std::filesystem::path path;
  std::vector<PlannedPart> parts;
};

// A file of the material that holds nothing to convert, and goes along byte for byte.
struct CopiedFile {
  std::filesystem::path source;
  std::string name;  // of the copy in layouts that name their files, without extension; empty: its own
};
struct PlannedCopy {
  std::filesystem::path source;
  std::filesystem::path path;
};

struct TargetPlan {
  std::vector<PlannedMap> maps;
  std::vector<PlannedCopy> copies;
};

// Which files the results are.
enum class Layout {
  kAsInputs,   // every map that holds something converted, under its name
  kSeparate,   // a file each: roughness, the colors, and what is carried
  kOrm,        // orm: occlusion, roughness, metallic; and the colors
  kArm,        // the same as arm
  kSpecGloss,  // specular_glossiness: specular, and glossiness in alpha; and diffuse
};
std::string_view layout_name(Layout layout);
std::optional<Layout> layout_from_name(std::string_view name);
std::vector<std::string> layout_names();

// What stands before and behind the names of results that have no input: `wood_` specular `.1001`.
struct ResultNames {
  std::string before;
  std::string after;
};

// `wood_mask.1001.png` of mask.png.
std::string set_file_name(const std::filesystem::path& file, const ResultNames& names);

// A map of what a conversion says of its result.
struct MeasureMap {
  Parameter measure = Parameter::kResidual;
  std::string name;  // of the file
};

struct TargetChoice {
  std::filesystem::path folder;
  std::vector<Parameter> parameters = {Parameter::kWidth, Parameter::kSpecular};  // that are wanted
  std::string width_name = "roughness";  // of its file where it has one of its own
  bool colors_stay_grey = true;  // those that are grey in the set, where they have a file of their own
  std::vector<MeasureMap> measures;
  std::string extension;            // of all files; empty: as the inputs
  std::optional<PixelType> type;    // of all files
  std::optional<std::string> mask;  // name of the file that marks texels out of domain
  ResultNames names;
  Layout layout = Layout::kAsInputs;
  std::vector<CopiedFile> copies;
  bool force = false;  // may replace files that exist
  Metadata metadata;
};

// The file that holds a parameter in the layouts that name their files, and where a parameter has no input to
// be named after; without what stands around it.
std::string file_name(Parameter parameter, const TargetChoice& choice);

// As inputs: every map of the set that holds something converted gives a file of its name, in which only that
// is changed (a color that is grey there and none in the result becomes three channels); a constant gives a
// map of its own (`roughness`, `specular`), and files of what is carried are copied. The other layouts name
// their files themselves; what is carried and has no channel there has a file, and coverage is the alpha of
// diffuse or base color. Parameters that the set does not have, since the converter makes them, have no
// place in as inputs: kUsage. Throws kUsage where two results would have one name, where one is an input,
// where one channel is two things, where a layout would lose a channel of an input or has no place for a
// constant, and for an unknown extension; kInput where a file to copy is not there; kOutput where a result
// exists and `force` is not set or where the folder is a file.
TargetPlan plan_targets(const TextureSet& set, const TargetChoice& choice);

// Throws kOutput where the folder of the results is not there and cannot be made, and where one cannot be
// opened.
std::vector<TargetMap> open_targets(const TextureSet& set, const TargetPlan& plan,
                                    const TargetChoice& choice);

}  // namespace remap
