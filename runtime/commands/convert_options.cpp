#include "commands/convert_options.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <thread>

#include <CLI/CLI.hpp>

#include "commands/converters_option.hpp"
#include "commands/workflow_choice.hpp"
#include "error.hpp"
#include "named_values.hpp"
#include "nearest_name.hpp"

namespace remap {
namespace {

// What the options say of a parameter.
const std::string& word_of(const ConvertOptions& options, Parameter parameter) {
  static const std::string kNone;
  switch (parameter) {
    case Parameter::kWidth:
      return options.roughness;
    case Parameter::kSpecular:
      return options.specular;
    case Parameter::kDiffuse:
      return options.diffuse;
    case Parameter::kBaseColor:
      return options.base_color;
    case Parameter::kMetallic:
      return options.metallic;
    case Parameter::kMetalMask:
      return options.metal_mask;
    default:
      return kNone;
  }
}

std::optional<RoughnessConvention> convention_of(const std::string& option, const std::string& word) {
  if (word.empty()) return std::nullopt;
  const auto convention = convention_from_name(word);
  if (!convention) fail_unknown(option, word, convention_names());
  return convention;
}

// `srgb`, or `specular=linear,diffuse=srgb`: of one colour.
std::optional<Transfer> transfer_of(const std::string& words, Parameter parameter) {
  std::optional<Transfer> chosen;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    std::string word = words.substr(begin, end - begin);
    begin = end + 1;
    if (const std::size_t sign = word.find('='); sign != std::string::npos) {
      const std::string name = word.substr(0, sign);
      const std::vector<std::string> colors = {"specular", "diffuse", "base_color"};
      if (std::find(colors.begin(), colors.end(), name) == colors.end())
        fail_unknown("--color-space", name, colors);
      word = word.substr(sign + 1);
      if (!transfer_from_name(word)) fail_unknown("--color-space", word, transfer_names());
      if (name != parameter_name(parameter)) continue;
    }
    chosen = transfer_from_name(word);
    if (!chosen) fail_unknown("--color-space", word, transfer_names());
  }
  return chosen;
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
                     "Metallic of a metallic workflow: a map, FILE:CHANNEL, or a number; else it is not "
                     "converted and goes where --layout has a place for it");
  command.add_option("--diffuse", options.diffuse,
                     "Diffuse of a specular workflow: a map or linear numbers; else the file is copied "
                     "beside the results");
  command.add_option("--base-color", options.base_color,
                     "Base colour of a metallic workflow: a map or linear numbers; else the file is copied "
                     "beside the results");
  command.add_option("--roughness-factor", options.roughness_factor,
                     "Multiplies the roughness map (or the glossiness map) before it is read");
  command.add_option("--specular-factor", options.specular_factor,
                     "Multiplies linear specular: one number, or three");
  command.add_option("--roughness-encoding", options.encoding,
                     "What the roughness map holds: alpha, roughness (its square root), squared, glossiness, "
                     "exponent; the default is the source model's own");
  command.add_option(
      "--color-space", options.color_space,
      "Of colour maps: srgb or linear, or of one: specular=linear,diffuse=srgb. The default: sRGB for colour "
      "in whole numbers that the file says to be sRGB (PNG, JPEG, TGA), else linear");
  command.add_flag("--resample", options.resample,
                   "Bring smaller maps of a set to the size of the largest, linearly between texels");
  command
      .add_option("--bad-texels", options.bad_texels,
                  "NaN, infinite and negative values: keep, clamp to what the converter covers, or fail")
      ->capture_default_str();
}

void add_output_options(CLI::App& command, ConvertOptions& options) {
  command.add_option("-o,--output", options.output, "Folder of the results; their names are the inputs'");
  command.add_option(
      "--layout", options.layout,
      "Files of the results: as-inputs (the default, but between workflows); separate (a file each); orm "
      "or arm (occlusion, roughness, metallic; and the colours); specgloss (specular, and glossiness in "
      "alpha; and diffuse)");
  command.add_option("--only", options.only, "Convert roughness or specular alone, the other one only read");
  command.add_option(
      "--output-encoding", options.output_encoding,
      "What the roughness results hold; the default is what --roughness-encoding or the name of the "
      "map says, else the target model's own");
  add_converters_option(command);
  command.add_option("--mask", options.mask, "Name of a map to write as well: 1 for texels out of domain");
  command.add_option(
      "--residual", options.residual,
      "Name of a map to write as well: what metallic cannot say of the texel; 0.42 of it is the "
      "difference of the pictures");
  command.add_option(
      "--metallic-width", options.metallic_width,
      "Name of a map to write as well: share of [0, 1] in which metallic could lie; above 0.2 it "
      "is a guess");
  command.add_option(
      "--doubts", options.doubts,
      "Name of a map to write as well: why metallic or base colour may not be those that were meant; in 8 "
      "bits the sum of 1 (clamped), 2 (two answers look alike), 4 (too dark to tell), 8 (metallic is a "
      "guess)");
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

void add_workflow_options(CLI::App& command, ConvertOptions& options) {
  command.add_option(
      "--from-workflow", options.from_workflow,
      "Of a BRDF model: specular (diffuse and specular) or metallic (base colour and metallic)");
  command.add_option("--to-workflow", options.to_workflow, "The same of the target");
  command.add_option(
      "--dielectric-f0", options.dielectric_f0,
      "F0 of what is no metal: a number, or estimate from the maps; the default is that of the "
      "metallic model, 0.04");
  command.add_option(
      "--diffuse-convention", options.diffuse_convention,
      "What diffuse of the source means: plain (reflectance) or scaled (times 1 - max(specular), "
      "as in glTF); the default is the model's own");
  command.add_option("--formula", options.formula,
                     "To metallic: projection (the default: the least difference of pictures), equation-3, "
                     "equation-3-mean, khronos");
  command.add_option(
      "--prior", options.prior,
      "How much the projection prefers 0 and 1: clean (the default), noisy (scans, JPEG), or a "
      "number");
  command.add_option("--metal-mask", options.metal_mask,
                     "Map of what is metal: chooses among metallic values that look alike");
  command.add_flag("--smooth-metallic", options.smooth_metallic,
                   "Where metallic is a guess on which the picture does not depend, follow the texels around "
                   "it that can tell; reads the maps twice");
}

// Which parameters a set must have: the name of what is missing ends the conversion.
void require_parameters(const ConvertOptions& options, const WorkflowChoice& workflow) {
  for (const Parameter parameter : workflow.sources()) {
    if (!word_of(options, parameter).empty() || workflow.constants.contains(parameter)) continue;
    if (parameter == Parameter::kWidth && !options.glossiness.empty()) continue;
    static const std::map<Parameter, std::string> kExpected = {
        {Parameter::kWidth, "a map or a number, or --glossiness"},
        {Parameter::kSpecular, "a map or a number (0.04 for most that is no metal)"},
        {Parameter::kDiffuse, "a map or a number (0 for bare metal)"},
        {Parameter::kBaseColor, "a map or numbers"},
        {Parameter::kMetallic, "a map or a number (0 where nothing is metal)"}};
    throw Error(ErrorKind::kUsage,
                parameter_option(parameter) + ": is missing; expected " + kExpected.at(parameter));
  }
}

// Words that go together with a folder of sets, or with one set.
void require_one_way(const ConvertOptions& options, const WorkflowChoice& workflow) {
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
  for (const Parameter parameter : {Parameter::kBaseColor, Parameter::kDiffuse})
    if (is_tree && !workflow.has_source(parameter) && !word_of(options, parameter).empty())
      throw Error(ErrorKind::kUsage, parameter_option(parameter) +
                                         ": is for one set; expected --copy-others beside a folder of sets");
  if (!is_tree) require_parameters(options, workflow);
  if (glossy && !options.encoding.empty())
    throw Error(ErrorKind::kUsage,
                "--roughness-encoding: does not go with --glossiness; expected --roughness");
}

void require_numbers(const ConvertOptions& options, const std::string& option,
                     const ParameterRequest& parameter) {
  if (const auto* map = std::get_if<MapName>(&parameter.source);
      !options.folder.empty() && map && !map->file.empty())
    throw Error(ErrorKind::kUsage,
                option + ": is the map " + map->file.string() + "; expected numbers beside a folder of sets");
}

// What the roughness maps hold: `--roughness` of a model whose own width is glossiness is roughness.
std::optional<RoughnessConvention> given_convention(const ConvertOptions& options,
                                                    const WorkflowChoice& workflow) {
  if (!options.glossiness.empty()) return RoughnessConvention::kGlossiness;
  if (!options.encoding.empty()) return convention_of("--roughness-encoding", options.encoding);
  if (!workflow.is_material()) return std::nullopt;
  const RoughnessConvention own = width_of(*workflow.source);
  return own == RoughnessConvention::kGlossiness ? RoughnessConvention::kRoughness : own;
}

}  // namespace

void fail_unknown(const std::string& option, const std::string& word, const std::vector<std::string>& known) {
  throw Error(ErrorKind::kUsage, option + ": is " + word + suggestion(word, known));
}

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
  add_workflow_options(command, options);
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

TextureSetRequest set_request(const ConvertOptions& options, const WorkflowChoice& workflow) {
  require_one_way(options, workflow);
  TextureSetRequest request;
  std::vector<Parameter> parameters = workflow.sources();
  if (!options.metal_mask.empty()) parameters.push_back(Parameter::kMetalMask);
  for (const Parameter parameter : parameters) {
    const bool glossy = parameter == Parameter::kWidth && !options.glossiness.empty();
    const std::string option = glossy ? "--glossiness" : parameter_option(parameter);
    const std::string& word = glossy ? options.glossiness : word_of(options, parameter);
    ParameterRequest asked;
    if (!word.empty()) asked.source = parameter_source(option, word);
    if (const auto constant = workflow.constants.find(parameter); constant != workflow.constants.end())
      asked.source = constant->second;
    require_numbers(options, option, asked);
    if (parameter == Parameter::kWidth)
      asked.factors = factors_of("--roughness-factor", options.roughness_factor);
    if (parameter == Parameter::kSpecular)
      asked.factors = factors_of("--specular-factor", options.specular_factor);
    if (is_color(parameter)) asked.transfer = transfer_of(options.color_space, parameter);
    request.parameters[parameter] = std::move(asked);
  }
  const auto carry = [&](const std::string& name, const std::string& text) {
    if (text.empty()) return;
    request.carried.push_back({name, {parameter_source("--" + name, text), {}, Transfer::kLinear}});
    require_numbers(options, "--" + name, request.carried.back().parameter);
  };
  carry("occlusion", options.occlusion);
  if (!workflow.has_source(Parameter::kMetallic) && !workflow.is_to_metallic())
    carry("metallic", options.metallic);
  request.resample = options.resample;
  request.convention = given_convention(options, workflow);
  return request;
}

std::vector<CopiedFile> copied_files(const ConvertOptions& options, const WorkflowChoice& workflow) {
  std::vector<CopiedFile> files;
  if (workflow.is_material()) return files;
  if (!options.diffuse.empty()) files.push_back({options.diffuse, "diffuse"});
  if (!options.base_color.empty()) files.push_back({options.base_color, "base_color"});
  return files;
}

TargetChoice target_choice(const ConvertOptions& options, const WorkflowChoice& workflow) {
  if (!options.only.empty() && options.only != "roughness" && options.only != "specular")
    fail_unknown("--only", options.only, {"roughness", "specular"});
  TargetChoice choice;
  choice.folder = options.output;
  const bool is_other_kind = workflow.is_material() && kind_of(*workflow.source) != kind_of(*workflow.target);
  const std::string word = !options.layout.empty()                        ? options.layout
                           : is_other_kind || !workflow.constants.empty() ? "separate"
                                                                          : "as-inputs";
  const auto layout = layout_from_name(word);
  if (!layout) fail_unknown("--layout", options.layout, layout_names());
  choice.layout = *layout;
  choice.extension = options.format;
  choice.type = chosen_type(options.type);
  if (!options.mask.empty()) choice.mask = options.mask;
  if (!options.residual.empty()) choice.measures.push_back({Parameter::kResidual, options.residual});
  if (!options.metallic_width.empty())
    choice.measures.push_back({Parameter::kMetallicWidth, options.metallic_width});
  if (!options.doubts.empty()) choice.measures.push_back({Parameter::kDoubts, options.doubts});
  choice.parameters = workflow.targets();
  choice.colors_stay_grey = !workflow.is_material();
  if (workflow.is_material() && width_of(*workflow.target) == RoughnessConvention::kGlossiness &&
      options.output_encoding.empty())
    choice.width_name = "glossiness";
  if (!options.only.empty())
    choice.parameters = {options.only == "specular" ? Parameter::kSpecular : Parameter::kWidth};
  choice.force = options.force;
  return choice;
}

PassOptions pass_options(const ConvertOptions& options) {
  PassOptions pass;
  pass.target_convention = convention_of("--output-encoding", options.output_encoding);
  pass.bad_texels = bad_texels_of(options.bad_texels);
  pass.dither = options.dither;
  pass.value_statistics = options.json;
  pass.metallic_statistics = options.json || !options.quiet;
  pass.smooth_metallic = options.smooth_metallic;
  return pass;
}

std::string result_options_text(const ConvertOptions& options) {
  std::string text;
  for (const std::string* word :
       {&options.specular,        &options.roughness,     &options.glossiness,
        &options.occlusion,       &options.metallic,      &options.roughness_factor,
        &options.specular_factor, &options.encoding,      &options.output_encoding,
        &options.color_space,     &options.only,          &options.bad_texels,
        &options.layout,          &options.format,        &options.type,
        &options.diffuse,         &options.base_color,    &options.from_workflow,
        &options.to_workflow,     &options.dielectric_f0, &options.diffuse_convention,
        &options.formula,         &options.prior,         &options.metal_mask})
    text += *word + '\n';
  return text + (options.dither ? "dither\n" : "") + (options.resample ? "resample\n" : "") +
         (options.smooth_metallic ? "smooth-metallic\n" : "");
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
