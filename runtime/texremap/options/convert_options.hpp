// This file declares the options of `texremap convert` as values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "assets/document/asset.hpp"
#include "command_line/command.hpp"
#include "remap/conversion.hpp"
#include "remap/converter.hpp"
#include "remap/model.hpp"
#include "remap/workflow.hpp"
#include "texremap/options/part.hpp"
#include "texremap/options/used_converters.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// These tags of options state when an option applies, and what its use changes.
enum : OptionTags {
  kChangesResults = 1u << 0u,
  kNeedsFiles = 1u << 1u,   // has no effect if all maps are numbers
  kNeedsFolder = 1u << 2u,  // needs a folder of texture sets
  kNeedsWorkflow = 1u << 3u,
  kNeedsMetallic = 1u << 4u,  // needs metallic as a result
  kNotWithWorkflow = 1u << 5u,
  kNotWithWarp = 1u << 6u,
  kNotWithDiffuseWarp = 1u << 7u,  // not with a warp whose source is only a diffuse map
  kNeedsAsset = 1u << 8u,          // needs assets instead of texture sets
  kNeedsGltf = 1u << 9u,           // needs a glTF file among the assets
  kForAssets = 1u << 10u,          // applies to assets as well as to texture sets
  kNeedsTree = 1u << 11u,          // if the run converts assets, needs a folder of assets
  kIsPath = 1u << 12u,             // path of a file or folder, relative to the working folder
  kOfPlan = 1u << 13u,             // texremap plan sets this option itself
};

using MapSource = std::variant<MapName, ConstantValues>;

// A ColorSpaceWord is the color space of one color, or of all colors if it has no parameter.
struct ColorSpaceWord {
  std::optional<Parameter> parameter;
  Transfer transfer;
};

// A ParameterWord is `NAME=VALUE`.
template <typename Value>
struct ParameterWord {
  Parameter parameter;
  Value value;
};

// A WrittenRoughness is what roughness results contain.
struct WrittenRoughness {
  std::optional<RoughnessEncoding> encoding;  // by default, see --output-encoding
  std::optional<double> white;                // the exponent that a stored value of 1 means, if known
};

// An F0Choice is the F0 of dielectrics, or where it comes from.
enum class F0Source { kModel, kMaps };
using F0Choice = std::variant<F0Source, double>;  // by default: the F0 of the model

// Returns a reader for a model in `--from` and `--to`.
Reader<ModelName> model_name();

// Returns the bytes of `megabytes`, or a quarter of the machine's memory for 0.
std::uint64_t memory_limit(int megabytes);
Option* add_memory_option(Command& command, int& megabytes);

enum class WrittenType { kUint8, kDithered, kUint16, kHalf, kFloat };

struct Compression {
  std::optional<int> level, jpeg_quality;
};

// A RunOptions holds the options that the plan of a conversion has unchanged.
struct RunOptions {
  std::filesystem::path output;
  std::filesystem::path report;  // HTML file about the conversion; empty for none
  std::optional<Part> part;      // part of the manifest
  bool force = false, dry_run = false;
  bool json = false, quiet = false, verbose = false;
};

struct ConvertOptions : RunOptions {
  std::vector<GivenOption> given;  // all options of the command line

  std::filesystem::path folder;  // folder of texture sets, or a glTF file; empty if options name one set
  std::vector<std::filesystem::path> more_assets;
  bool assets = false;               // the folder holds assets, not texture sets
  std::filesystem::path asset_root;  // the folder before named assets, which may use any file in it
  DielectricExtensions extensions = DielectricExtensions::kKept;
  bool keep_unused = false;
  ModelName from, to;
  std::vector<std::string> via;
  UsedConverters converters;
  bool recursive = false;
  bool follow_links = false;       // follows links that lead out of the input folder
  std::filesystem::path manifest;  // lists the sets or assets, so that the folder is not searched

  std::map<Parameter, std::optional<MapSource>> maps;
  std::optional<MapSource> glossiness;                  // also in `maps`, as roughness
  std::optional<RoughnessEncoding> roughness_encoding;  // encoding of roughness maps
  std::vector<ParameterWord<MapSource>> inputs;         // also in `maps`
  std::vector<ParameterWord<std::vector<float>>> factors;
  std::vector<std::string> prefer;  // choice among several maps of one parameter
  std::vector<ColorSpaceWord> color_spaces;
  std::filesystem::path names;
  bool resample = false;

  F0Choice dielectric_f0;
  double prior = kCleanPrior;

  std::optional<Layout> layout;
  const NamedLayout* engine = nullptr;  // engine whose files are written (choose_files())
  std::string format;
  std::optional<WrittenType> written_type;  // also in `type`
  std::optional<PixelType> type;
  Compression compression;
  WrittenRoughness output_roughness;
  std::vector<ColorSpaceWord> output_color_spaces;
  std::optional<Parameter> only;
  std::filesystem::path diagnose;  // folder for diagnosis maps; empty for none
  BadTexels bad_texels = BadTexels::kKeep;
  bool only_converted = false;
  InstructionSet instructions = best_instruction_set();
  int thread_count = 0;  // 0 for one per core
  int threads() const;
  int memory_megabytes = 0;  // 0 for a quarter of the machine's memory
  std::uint64_t memory_bytes() const { return memory_limit(memory_megabytes); }

  // Returns null if the option of the parameter was not given.
  const MapSource* map_of(Parameter parameter) const {
    const auto found = maps.find(parameter);
    return found == maps.end() || !found->second ? nullptr : &*found->second;
  }
  std::vector<float> factors_of(Parameter parameter) const;
  // Returns true if the roughness map was given as glossiness.
  bool reads_glossiness() const { return glossiness.has_value(); }
};

void add_convert_options(Command& command, ConvertOptions& options);

// Chooses the files of the engine that `--layout` or `--to` names. Its format and pixel type apply unless the
// user gave others.
void choose_files(ConvertOptions& options);

// Returns the direction of green in normal maps of a source or target, or nothing if it is not documented.
std::optional<NormalGreen> normals_of(const ModelName& model);

// Returns the program that wrote the MTL files, by `--from`. If unset, it is detected.
std::optional<MtlMaker> mtl_maker_of(const ConvertOptions& options);

// Throws kUsage if an option with `tag` was given, with the option and the reason.
void refuse(const ConvertOptions& options, OptionTags tag, const std::string& reason);

// Records the options of the command line that `command` has read, and their consequences.
void note_given(const Command& command, ConvertOptions& options);

// Returns all options that the results depend on, as on a command line.
std::string result_options_text(const ConvertOptions& options);

// Prints a line to standard error: `texremap: text`.
void say(const std::string& text);

}  // namespace remap
