#include "commands/convert_options.hpp"

#include <algorithm>
#include <array>
#include <thread>

#include <CLI/CLI.hpp>

#include "error.hpp"
#include "named_values.hpp"
#include "nearest_name.hpp"

namespace remap {
namespace {

[[noreturn]] void fail_unknown(const std::string& option, const std::string& word,
                               const std::vector<std::string>& known) {
  throw Error(ErrorKind::kUsage, option + ": is " + word + suggestion(word, known));
}

std::optional<RoughnessConvention> convention_of(const std::string& option, const std::string& word) {
  if (word.empty()) return std::nullopt;
  const auto convention = convention_from_name(word);
  if (!convention) fail_unknown(option, word, convention_names());
  return convention;
}

std::optional<Transfer> transfer_of(const std::string& word) {
  if (word.empty()) return std::nullopt;
  const auto transfer = transfer_from_name(word);
  if (!transfer) fail_unknown("--color-space", word, transfer_names());
  return transfer;
}

std::optional<PixelType> chosen_type(const std::string& name) {
  if (name.empty()) return std::nullopt;
  const std::vector<std::string> known = {"uint8", "uint16", "half", "float"};
  if (std::find(known.begin(), known.end(), name) == known.end()) fail_unknown("--type", name, known);
  return pixel_type_from_name(name);
}

constexpr NamedValues<BadTexels, 3> kBadTexels = {
    {{BadTexels::kKeep, "keep"}, {BadTexels::kClamp, "clamp"}, {BadTexels::kFail, "fail"}}};

BadTexels bad_texels_of(const std::string& word) {
  const auto known = value_named(kBadTexels, word);
  if (!known) fail_unknown("--bad-texels", word, names_of(kBadTexels));
  return *known;
}

std::vector<float> factors_of(const std::string& option, const std::string& text) {
  return text.empty() ? std::vector<float>{} : parse_factors(option, text);
}

void add_input_options(CLI::App& command, ConvertOptions& options) {
  command.add_option("DIR", options.folder, "Folder of texture sets, found by the names of their maps");
  command.add_flag("-r,--recursive", options.recursive,
                   "The folders below DIR, too; results mirror the tree");
  command.add_option("--names", options.names,
                     "Naming habits of your own (JSON), besides those of common tools");
  CLI::Option* roughness =
      command.add_option("--roughness", options.roughness,
                         "Roughness of the source model: a map, FILE:CHANNEL of a packed one, or a number");
  command
      .add_option("--glossiness", options.glossiness,
                  "The same as glossiness, 1 - sqrt(alpha): --roughness with --roughness-encoding glossiness")
      ->excludes(roughness);
  command.add_option(
      "--specular", options.specular,
      "Specular: a map, FILE:CHANNEL or FILE:R,G,B, or linear numbers: 0.5, or 0.9,0.6,0.2; with "
      "DIR for the sets that have no such map");
  command.add_option("--occlusion", options.occlusion,
                     "Ambient occlusion: not converted; goes where --layout has a place for it");
  command.add_option("--metallic", options.metallic,
                     "Metallic: not converted; goes where --layout has a place for it");
  command.add_option("--diffuse", options.diffuse,
                     "Diffuse map: not converted; the file is copied beside the results");
  command.add_option("--base-color", options.base_color,
                     "Base colour map: not converted; the file is copied beside the results");
  command.add_option("--roughness-factor", options.roughness_factor,
                     "Multiplies the roughness map (or the glossiness map) before it is read");
  command.add_option("--specular-factor", options.specular_factor,
                     "Multiplies linear specular: one number, or three");
  command.add_option("--roughness-encoding", options.encoding,
                     "What the roughness map holds: alpha, roughness (its square root), squared, glossiness, "
                     "exponent; the default is the source model's own");
  command.add_option(
      "--color-space", options.color_space,
      "Of a specular map: srgb or linear. The default: sRGB for colour in whole numbers that the "
      "file says to be sRGB (PNG, JPEG, TGA), else linear");
  command.add_flag("--resample", options.resample,
                   "Bring smaller maps of a set to the size of the largest, linearly between texels");
  command
      .add_option("--bad-texels", options.bad_texels,
                  "NaN, infinite and negative values: keep, clamp to what the converter covers, or fail")
      ->capture_default_str();
}

void add_output_options(CLI::App& command, ConvertOptions& options) {
  command.add_option("-o,--output", options.output, "Folder of the results; their names are the inputs'");
  command
      .add_option(
          "--layout", options.layout,
          "Files of the results: as-inputs; separate (a file each); orm or arm (occlusion, roughness, "
          "metallic; and specular); specgloss (specular, and glossiness in alpha)")
      ->capture_default_str();
  command.add_option("--only", options.only, "Convert roughness or specular alone, the other one only read");
  command.add_option(
      "--output-encoding", options.output_encoding,
      "What the roughness results hold; the default is what --roughness-encoding or the name of the "
      "map says, else the target model's own");
  command.add_option("--mask", options.mask, "Name of a map to write as well: 1 for texels out of domain");
  command.add_option("--format", options.format, "Extension of the results: exr, tif, png, ...");
  command.add_option("--type", options.type, "Pixel type of the results: uint8, uint16, half, float");
  command.add_flag("--dither", options.dither,
                   "Noise of half a step where results have 8 bits; the same in every run");
  command.add_flag("--copy-others", options.copy_others,
                   "With DIR: copy the other maps of each set as well (base colour, normal, ...)");
  command.add_flag("--dry-run", options.dry_run, "Say what would be written, and write nothing");
  command.add_flag(
      "--resume", options.resume,
      "Leave out sets whose results are there and were made of the same inputs and options; make "
      "the others");
  command.add_flag("--force", options.force,
                   "Replace results that exist (never an input); convert converted maps");
}

}  // namespace

void add_convert_options(CLI::App& command, ConvertOptions& options) {
  command.add_option("--from", options.from, "Source model, e.g. mitsuba/ward");
  command.add_option("--to", options.to, "Target model, e.g. mitsuba/as");
  CLI::Option* via =
      command
          .add_option("--via", options.via,
                      "Model that the path must go through; give it again for more, in their order")
          ->allow_extra_args(false);
  command.add_option("--fit", options.fit, "Lower this fit (JSON) instead of taking compiled converters")
      ->excludes(via);
  add_input_options(command, options);
  add_output_options(command, options);
  command.add_option("--threads", options.thread_count, "Threads; 0, the default, is one a core")
      ->check(CLI::Range(0, 1024));
  command.add_option("--instructions", options.instructions,
                     "baseline, avx2 or avx512; the default is the widest of this processor. The results "
                     "are the same");
  command.add_flag("--json", options.json, "Machine-readable result on standard output, with histograms");
  command.add_flag("--quiet", options.quiet, "Nothing on standard error but failures");
}

TextureSetRequest set_request(const ConvertOptions& options) {
  const bool glossy = !options.glossiness.empty(), is_tree = !options.folder.empty();
  if (is_tree && (glossy || !options.roughness.empty()))
    throw Error(ErrorKind::kUsage, options.folder +
                                       ": its sets are found by their names; expected no --roughness " +
                                       "and no --glossiness beside it");
  if (!is_tree && (options.recursive || options.copy_others || !options.names.empty()))
    throw Error(ErrorKind::kUsage, std::string(options.recursive     ? "--recursive"
                                               : options.copy_others ? "--copy-others"
                                                                     : "--names") +
                                       ": is for a folder of sets; expected DIR");
  if (is_tree && !(options.diffuse.empty() && options.base_color.empty()))
    throw Error(ErrorKind::kUsage, std::string(options.diffuse.empty() ? "--base-color" : "--diffuse") +
                                       ": is for one set; expected --copy-others beside a folder of sets");
  if (!is_tree && options.roughness.empty() && !glossy)
    throw Error(ErrorKind::kUsage, "--roughness: is missing; expected a map or a number, or --glossiness");
  if (!is_tree && options.specular.empty())
    throw Error(ErrorKind::kUsage,
                "--specular: is missing; expected a map or a number (0.04 for most that is no metal)");
  if (glossy && !options.encoding.empty())
    throw Error(ErrorKind::kUsage,
                "--roughness-encoding: does not go with --glossiness; expected --roughness");
  TextureSetRequest request;
  request.roughness.source = glossy ? parameter_source("--glossiness", options.glossiness)
                                    : parameter_source("--roughness", options.roughness);
  request.roughness.factors = factors_of("--roughness-factor", options.roughness_factor);
  if (!options.specular.empty()) request.specular.source = parameter_source("--specular", options.specular);
  const auto require_numbers = [&](const std::string& name, const ParameterRequest& parameter) {
    if (const auto* map = std::get_if<MapName>(&parameter.source); is_tree && map && !map->file.empty())
      throw Error(ErrorKind::kUsage, "--" + name + ": is the map " + map->file.string() +
                                         "; expected numbers beside a folder of sets");
  };
  require_numbers("specular", request.specular);
  request.specular.factors = factors_of("--specular-factor", options.specular_factor);
  request.specular.transfer = transfer_of(options.color_space);
  const auto carry = [&](const std::string& name, const std::string& text) {
    if (text.empty()) return;
    request.carried.push_back({name, {parameter_source("--" + name, text), {}, Transfer::kLinear}});
    require_numbers(name, request.carried.back().parameter);
  };
  carry("occlusion", options.occlusion);
  carry("metallic", options.metallic);
  request.resample = options.resample;
  request.convention =
      glossy ? RoughnessConvention::kGlossiness : convention_of("--roughness-encoding", options.encoding);
  return request;
}

std::vector<CopiedFile> copied_files(const ConvertOptions& options) {
  std::vector<CopiedFile> files;
  if (!options.diffuse.empty()) files.push_back({options.diffuse, "diffuse"});
  if (!options.base_color.empty()) files.push_back({options.base_color, "base_color"});
  return files;
}

TargetChoice target_choice(const ConvertOptions& options) {
  if (!options.only.empty() && options.only != "roughness" && options.only != "specular")
    fail_unknown("--only", options.only, {"roughness", "specular"});
  TargetChoice choice;
  choice.folder = options.output;
  const auto layout = layout_from_name(options.layout);
  if (!layout) fail_unknown("--layout", options.layout, layout_names());
  choice.layout = *layout;
  choice.extension = options.format;
  choice.type = chosen_type(options.type);
  if (!options.mask.empty()) choice.mask = options.mask;
  choice.roughness = options.only != "specular";
  choice.specular = options.only != "roughness";
  choice.force = options.force;
  return choice;
}

PassOptions pass_options(const ConvertOptions& options) {
  PassOptions pass;
  pass.target_convention = convention_of("--output-encoding", options.output_encoding);
  pass.bad_texels = bad_texels_of(options.bad_texels);
  pass.dither = options.dither;
  pass.value_statistics = options.json;
  return pass;
}

std::string result_options_text(const ConvertOptions& options) {
  std::string text;
  for (const std::string* word :
       {&options.specular, &options.roughness, &options.glossiness, &options.occlusion, &options.metallic,
        &options.roughness_factor, &options.specular_factor, &options.encoding, &options.output_encoding,
        &options.color_space, &options.only, &options.bad_texels, &options.layout, &options.format,
        &options.type})
    text += *word + '\n';
  return text + (options.dither ? "dither\n" : "") + (options.resample ? "resample\n" : "");
}

InstructionSet chosen_instructions(const ConvertOptions& options) {
  if (options.instructions.empty()) return best_instruction_set();
  return instruction_set_from_name("--instructions", options.instructions);
}

int thread_count(const ConvertOptions& options) {
  if (options.thread_count > 0) return options.thread_count;
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace remap
