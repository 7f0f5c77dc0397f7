#include "texremap/conversion_request.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <thread>

#include "remap/error.hpp"
#include "text/nearest_name.hpp"

namespace remap {
namespace {

// The value of the option of a source parameter; empty where it was not given.
const std::string& word_of(const ConvertOptions& options, Parameter parameter) {
  static const std::map<Parameter, std::string ConvertOptions::*> kOptions = {
      {Parameter::kWidth, &ConvertOptions::roughness},
      {Parameter::kSpecular, &ConvertOptions::specular},
      {Parameter::kDiffuse, &ConvertOptions::diffuse},
      {Parameter::kBaseColor, &ConvertOptions::base_color},
      {Parameter::kMetallic, &ConvertOptions::metallic},
      {Parameter::kMetalMask, &ConvertOptions::metal_mask}};
  return options.*kOptions.at(parameter);
}

std::optional<RoughnessConvention> convention_of(const std::string& option, const std::string& word) {
  if (word.empty()) return std::nullopt;
  return chosen_value(kConventions, option, "encoding", word);
}

// Finds the color space of `parameter` in a list such as `srgb` or `specular=linear,diffuse=srgb`.
std::optional<Transfer> transfer_of(const std::string& words, Parameter parameter) {
  static const std::vector<std::string> kColors = {"specular", "diffuse", "base_color"};
  std::optional<Transfer> chosen;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    const std::string word = words.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t sign = word.find('=');
    const std::string name = sign == std::string::npos ? "" : word.substr(0, sign);
    if (sign != std::string::npos && std::find(kColors.begin(), kColors.end(), name) == kColors.end())
      fail_unknown("--color-space", "color", name, kColors);
    // Without a sign, npos + 1 is 0: the whole word.
    const Transfer transfer = chosen_value(kTransfers, "--color-space", "color space", word.substr(sign + 1));
    if (sign == std::string::npos || name == parameter_name(parameter)) chosen = transfer;
  }
  return chosen;
}

std::optional<PixelType> chosen_type(const std::string& name) {
  if (name.empty()) return std::nullopt;
  constexpr NamedValues<PixelType, 4> kWritten = {{{PixelType::kUint8, "uint8"},
                                                   {PixelType::kUint16, "uint16"},
                                                   {PixelType::kHalf, "half"},
                                                   {PixelType::kFloat, "float"}}};
  return chosen_value(kWritten, "--type", "pixel type", name);
}

constexpr NamedValues<BadTexels, 3> kBadTexels = {
    {{BadTexels::kKeep, "keep"}, {BadTexels::kClamp, "clamp"}, {BadTexels::kFail, "fail"}}};

std::vector<float> factors_of(const std::string& option, const std::string& text) {
  return text.empty() ? std::vector<float>{} : parse_factors(option, text);
}

// Throws for the first source parameter without an option.
void require_parameters(const ConvertOptions& options, const WorkflowChoice& workflow) {
  for (const Parameter parameter : workflow.sources()) {
    if (!word_of(options, parameter).empty() || workflow.constants.contains(parameter)) continue;
    if (parameter == Parameter::kWidth && !options.glossiness.empty()) continue;
    static const std::map<Parameter, std::string> kRemedies = {
        {Parameter::kWidth, "a map or a number; or use --glossiness"},
        {Parameter::kSpecular, "a map or a number; 0.04 for most dielectrics"},
        {Parameter::kDiffuse, "a map or a number; 0 for bare metal"},
        {Parameter::kBaseColor, "a map or numbers"},
        {Parameter::kMetallic, "a map or a number; 0 for dielectrics"}};
    throw Error(ErrorKind::kUsage,
                parameter_option(parameter) + " is required (" + kRemedies.at(parameter) + ")");
  }
}

// Refuses options of a single set with a folder, and options of a folder with a single set.
void require_one_way(const ConvertOptions& options, const WorkflowChoice& workflow) {
  const bool glossy = !options.glossiness.empty(), is_tree = !options.folder.empty();
  if (is_tree && (glossy || !options.roughness.empty()))
    throw Error(ErrorKind::kUsage, std::string(glossy ? "--glossiness" : "--roughness") +
                                       " cannot be used with a folder (its sets are found by name)");
  if (!is_tree && (options.recursive || options.copy_others || !options.names.empty()))
    throw Error(ErrorKind::kUsage, std::string(options.recursive     ? "--recursive"
                                               : options.copy_others ? "--copy-others"
                                                                     : "--names") +
                                       " requires a folder of sets (give DIR)");
  for (const Parameter parameter : {Parameter::kBaseColor, Parameter::kDiffuse})
    if (is_tree && !workflow.has_source(parameter) && !word_of(options, parameter).empty())
      throw Error(ErrorKind::kUsage,
                  parameter_option(parameter) + " cannot be used with a folder (use --copy-others)");
  if (!is_tree) require_parameters(options, workflow);
  if (glossy && !options.encoding.empty())
    throw Error(ErrorKind::kUsage, "--roughness-encoding cannot be used with --glossiness (use --roughness)");
}

void require_numbers(const ConvertOptions& options, const std::string& option,
                     const ParameterRequest& parameter) {
  if (const auto* map = std::get_if<MapName>(&parameter.source);
      !options.folder.empty() && map && !map->file.empty())
    throw Error(ErrorKind::kUsage,
                option + ": the map " + map->file.string() + " cannot be used with a folder (give numbers)");
}

// The encoding of the roughness maps. `--roughness` means roughness even for a model that takes glossiness.
std::optional<RoughnessConvention> given_convention(const ConvertOptions& options,
                                                    const WorkflowChoice& workflow) {
  if (!options.glossiness.empty()) return RoughnessConvention::kGlossiness;
  if (!options.encoding.empty()) return convention_of("--roughness-encoding", options.encoding);
  if (!workflow.is_material()) return std::nullopt;
  const RoughnessConvention own = width_of(*workflow.source);
  return own == RoughnessConvention::kGlossiness ? RoughnessConvention::kRoughness : own;
}

}  // namespace

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
    fail_unknown("--only", "parameter", options.only, {"roughness", "specular"});
  TargetChoice choice;
  choice.folder = options.output;
  const bool is_other_kind = workflow.is_material() && kind_of(*workflow.source) != kind_of(*workflow.target);
  const std::string word = !options.layout.empty()                        ? options.layout
                           : is_other_kind || !workflow.constants.empty() ? "separate"
                                                                          : "as-inputs";
  choice.layout = chosen_value(kLayouts, "--layout", "layout", word);
  choice.extension = options.format;
  choice.type = chosen_type(options.type);
  const auto add_diagnosis = [&](const TargetChannel& content, const std::string& file) {
    if (!file.empty()) choice.diagnoses.push_back({content, file});
  };
  add_diagnosis(MaskChannel{}, options.mask);
  add_diagnosis(ConvertedChannel{Parameter::kResidual}, options.residual);
  add_diagnosis(ConvertedChannel{Parameter::kMetallicWidth}, options.metallic_width);
  add_diagnosis(ConvertedChannel{Parameter::kDoubts}, options.doubts);
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
  pass.bad_texels = chosen_value(kBadTexels, "--bad-texels", "treatment", options.bad_texels);
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
