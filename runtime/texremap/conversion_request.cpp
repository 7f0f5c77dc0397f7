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

constexpr std::array kColors = {Parameter::kSpecular, Parameter::kDiffuse, Parameter::kBaseColor};

// One word of a list such as `srgb` or `specular=linear,diffuse=srgb`; without a parameter it is for all
// colors.
struct ColorSpaceWord {
  std::optional<Parameter> parameter;
  Transfer transfer;
};

ColorSpaceWord color_space_word(const std::string& option, const std::string& word) {
  const std::size_t sign = word.find('=');
  // Without a sign, npos + 1 is 0: the whole word.
  const Transfer transfer = chosen_value(kTransfers, option, "color space", word.substr(sign + 1));
  if (sign == std::string::npos) return {std::nullopt, transfer};
  const std::string name = word.substr(0, sign);
  std::vector<std::string> known;
  for (const Parameter color : kColors) {
    known.emplace_back(parameter_name(color));
    if (known.back() == name) return {color, transfer};
  }
  fail_unknown(option, "color", name, known);
}

// The color space of each of `colors`, as far as `words` say one. Throws kUsage for a word that applies to
// none of them; `reason` is why another color is not among them.
std::map<Parameter, Transfer> color_spaces(const std::string& option, const std::string& words,
                                           const std::vector<Parameter>& colors, const std::string& reason) {
  std::map<Parameter, Transfer> chosen;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    const ColorSpaceWord word = color_space_word(option, words.substr(begin, end - begin));
    begin = end + 1;
    bool applies = false;
    for (const Parameter color : colors) {
      if (word.parameter.value_or(color) != color) continue;
      chosen[color] = word.transfer;
      applies = true;
    }
    if (!applies)
      throw Error(ErrorKind::kUsage,
                  option + ": applies to nothing, because " +
                      (word.parameter ? std::string(parameter_name(*word.parameter)) : "no color") + " " +
                      reason);
  }
  return chosen;
}

// The colors that may be read from maps: with a folder all of the source.
std::map<Parameter, Transfer> color_spaces_read(const ConvertOptions& options,
                                                const WorkflowChoice& workflow) {
  std::vector<Parameter> colors;
  for (const Parameter color : kColors) {
    const std::string& word = workflow.has_source(color) ? word_of(options, color) : "";
    const bool is_map =
        !word.empty() && std::holds_alternative<MapName>(parameter_source(parameter_option(color), word));
    if (workflow.has_source(color) && (is_map || !options.folder.empty())) colors.push_back(color);
  }
  return color_spaces("--color-space", options.color_space, colors,
                      "is read from a map (--output-color-space is for results)");
}

std::vector<Parameter> written_colors(const std::vector<Parameter>& written) {
  std::vector<Parameter> colors;
  for (const Parameter parameter : written)
    if (is_color(parameter)) colors.push_back(parameter);
  return colors;
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

// Refuses maps and numbers that the conversion does not read.
void require_read(const ConvertOptions& options, const WorkflowChoice& workflow) {
  const auto refuse = [&](const std::string& option, bool is_result) {
    throw Error(ErrorKind::kUsage,
                option + ": applies to nothing, because the source material has no " +
                    option.substr(2, option.find("-factor") - 2) +
                    (is_result ? " (it is a result of this conversion)" : " (remove this option)"));
  };
  const std::vector<Parameter> targets = workflow.targets();
  for (const Parameter parameter :
       {Parameter::kSpecular, Parameter::kDiffuse, Parameter::kBaseColor, Parameter::kMetallic}) {
    const bool is_result = std::find(targets.begin(), targets.end(), parameter) != targets.end();
    // Without a workflow, colors are copied and metallic has a place in some layouts.
    const bool has_place = !workflow.is_material() || (parameter == Parameter::kMetallic && !is_result);
    if (!workflow.has_source(parameter) && !has_place && !word_of(options, parameter).empty())
      refuse(parameter_option(parameter), is_result);
  }
  if (!workflow.has_source(Parameter::kSpecular) && !options.specular_factor.empty())
    refuse("--specular-factor", false);
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
  require_read(options, workflow);
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
  const std::map<Parameter, Transfer> transfers = color_spaces_read(options, workflow);
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
    if (const auto found = transfers.find(parameter); found != transfers.end())
      asked.transfer = found->second;
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

namespace {

// Refuses an encoding of the results that their names contradict or that nothing is written in.
void require_encoding(const ConvertOptions& options, const TargetChoice& choice) {
  const auto asked = convention_of("--output-encoding", options.output_encoding);
  if (!asked) return;
  const bool is_glossiness = *asked == RoughnessConvention::kGlossiness;
  const bool is_orm = choice.layout == Layout::kOrm || choice.layout == Layout::kArm;
  if ((is_glossiness && is_orm) || (!is_glossiness && choice.layout == Layout::kSpecGloss))
    throw Error(ErrorKind::kUsage, "--output-encoding " + options.output_encoding +
                                       " cannot be used with --layout " +
                                       std::string(name_of(kLayouts, choice.layout)) + ", which holds " +
                                       (is_orm ? "roughness" : "glossiness"));
  if (options.only == "specular")
    throw Error(ErrorKind::kUsage,
                "--output-encoding: applies to nothing, because --only specular writes no roughness");
}

}  // namespace

RoughnessConvention written_width(const ConvertOptions& options, const TargetChoice& choice,
                                  const WidthSource& source, RoughnessConvention usual) {
  constexpr auto kGlossiness = RoughnessConvention::kGlossiness, kRoughness = RoughnessConvention::kRoughness;
  if (choice.layout == Layout::kSpecGloss) return kGlossiness;
  const auto asked = convention_of("--output-encoding", options.output_encoding);
  const RoughnessConvention wanted = asked.value_or(usual);
  if (choice.layout == Layout::kSeparate) return wanted;
  const bool keeps_name = choice.layout == Layout::kAsInputs && !source.file.empty();
  if (!keeps_name) return choice.layout != Layout::kAsInputs && wanted == kGlossiness ? kRoughness : wanted;
  const bool is_glossy = source.convention == kGlossiness;
  if (asked && is_glossy != (*asked == kGlossiness))
    throw Error(ErrorKind::kUsage, "--output-encoding " + options.output_encoding +
                                       ": the result keeps the name " + source.file.filename().string() +
                                       ", which holds " + (is_glossy ? "glossiness" : "roughness") +
                                       " (use --layout separate)");
  if (is_glossy) return kGlossiness;
  return wanted == kGlossiness ? kRoughness : wanted;
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
  if (!options.only.empty())
    choice.parameters = {options.only == "specular" ? Parameter::kSpecular : Parameter::kWidth};
  choice.color_transfers = color_spaces("--output-color-space", options.output_color_space,
                                        written_colors(choice.parameters), "is a result");
  choice.force = options.force;
  require_encoding(options, choice);
  return choice;
}

PassOptions pass_options(const ConvertOptions& options) {
  PassOptions pass;
  pass.target_convention = convention_of("--output-encoding", options.output_encoding);
  pass.bad_texels = chosen_value(kBadTexels, "--bad-texels", "treatment", options.bad_texels);
  pass.dither = options.dither;
  pass.value_statistics = options.json;
  if (options.histograms && !options.json) throw Error(ErrorKind::kUsage, "--histograms requires --json");
  if (options.allow_skips && options.folder.empty())
    throw Error(ErrorKind::kUsage, "--allow-skips requires a folder of sets (give DIR)");
  pass.metallic_statistics = options.json || !options.quiet;
  pass.smooth_metallic = options.smooth_metallic;
  return pass;
}

std::string result_options_text(const ConvertOptions& options) {
  using O = ConvertOptions;
  constexpr std::pair<const char*, std::string O::*> kWords[] = {
      {"--specular", &O::specular},
      {"--roughness", &O::roughness},
      {"--glossiness", &O::glossiness},
      {"--occlusion", &O::occlusion},
      {"--metallic", &O::metallic},
      {"--diffuse", &O::diffuse},
      {"--base-color", &O::base_color},
      {"--metal-mask", &O::metal_mask},
      {"--roughness-factor", &O::roughness_factor},
      {"--specular-factor", &O::specular_factor},
      {"--roughness-encoding", &O::encoding},
      {"--output-encoding", &O::output_encoding},
      {"--color-space", &O::color_space},
      {"--output-color-space", &O::output_color_space},
      {"--only", &O::only},
      {"--layout", &O::layout},
      {"--format", &O::format},
      {"--type", &O::type},
      {"--names", &O::names},
      {"--from-workflow", &O::from_workflow},
      {"--to-workflow", &O::to_workflow},
      {"--dielectric-f0", &O::dielectric_f0},
      {"--diffuse-convention", &O::diffuse_convention},
      {"--formula", &O::formula},
      {"--prior", &O::prior},
      {"--mask", &O::mask},
      {"--residual", &O::residual},
      {"--metallic-width", &O::metallic_width},
      {"--doubts", &O::doubts}};
  constexpr std::pair<const char*, bool O::*> kFlags[] = {{"--copy-others", &O::copy_others},
                                                          {"--dither", &O::dither},
                                                          {"--resample", &O::resample},
                                                          {"--smooth-metallic", &O::smooth_metallic}};
  std::string text;
  const auto add = [&text](const std::string& words) { text += (text.empty() ? "" : " ") + words; };
  for (const auto& [name, member] : kWords)
    if (!(options.*member).empty()) add(std::string(name) + " " + options.*member);
  for (const auto& [name, member] : kFlags)
    if (options.*member) add(name);
  if (options.bad_texels != "keep") add("--bad-texels " + options.bad_texels);
  return text;
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
