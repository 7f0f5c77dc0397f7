#include "texremap/plan/conversion_request.hpp"

#include <algorithm>
#include <map>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

std::vector<Parameter> colors_among(std::vector<Parameter> parameters) {
  std::erase_if(parameters, [](Parameter parameter) { return !is_color(parameter); });
  return parameters;
}

// Returns the color spaces that `words` give to `colors`. Throws kUsage for a word that applies to none of
// these colors. `reason` ends the message, for example "no specular is written".
std::map<Parameter, Transfer> color_spaces(const std::string& option,
                                           const std::vector<ColorSpaceWord>& words,
                                           const std::vector<Parameter>& colors, const std::string& reason) {
  std::map<Parameter, Transfer> chosen;
  for (const ColorSpaceWord& word : words) {
    bool applies = false;
    for (const Parameter color : colors) {
      if (word.parameter.value_or(color) != color) continue;
      chosen[color] = word.transfer;
      applies = true;
    }
    if (!applies)
      throw usage_error(option + ": has no effect, because no " +
                        (word.parameter ? std::string(parameter_name(*word.parameter)) : "color") + " " +
                        reason);
  }
  return chosen;
}

// Returns the colors that may be read from maps. With a folder these are all colors of the source.
std::map<Parameter, Transfer> color_spaces_read(const ConvertOptions& options,
                                                const ConversionChoice& workflow) {
  std::vector<Parameter> colors = colors_among(workflow.sources());
  std::erase_if(colors, [&](Parameter color) {
    const MapSource* source = options.map_of(color);
    const bool is_map = source != nullptr && std::holds_alternative<MapName>(*source);
    return !is_map && options.folder.empty();
  });
  return color_spaces("--color-space", options.color_spaces, colors,
                      "is read from a map (for results, use --output-color-space)");
}

// Throws for the first source parameter without an option.
void require_parameters(const ConvertOptions& options, const ConversionChoice& workflow) {
  for (const Parameter parameter : workflow.sources()) {
    if (options.map_of(parameter) != nullptr || workflow.constants.contains(parameter)) continue;
    static const std::map<Parameter, std::string> kRemedies = {
        {Parameter::kRoughness, "a map or a number; or use --glossiness"},
        {Parameter::kSpecular, "a map or a number; 0.04 for most dielectrics"},
        {Parameter::kDiffuse, "a map or a number; 0 for bare metal"},
        {Parameter::kBaseColor, "a map or numbers"},
        {Parameter::kMetallic, "a map or a number; 0 for dielectrics"}};
    throw usage_error(parameter_option(parameter) + " is required (" + kRemedies.at(parameter) + ")");
  }
}

// Refuses maps and numbers that the conversion does not read.
void require_read(const ConvertOptions& options, const ConversionChoice& workflow) {
  const auto refuse_map = [](const std::string& option, bool is_result) {
    throw usage_error(
        option + ": has no effect, because the source material has no " +
        option.substr(2, option.find("-factor") - 2) +
        (is_result ? " (this conversion writes it; remove this option)" : " (remove this option)"));
  };
  const std::vector<Parameter> targets = workflow.targets();
  for (const Parameter parameter :
       {Parameter::kSpecular, Parameter::kDiffuse, Parameter::kBaseColor, Parameter::kMetallic}) {
    const bool is_result = contains(targets, parameter);
    // Without a workflow, colors are copied and metallic has a place in some layouts.
    const bool has_place = !workflow.is_material() || (parameter == Parameter::kMetallic && !is_result);
    if (!workflow.has_source(parameter) && !has_place && options.map_of(parameter) != nullptr)
      refuse_map(parameter_option(parameter), is_result);
  }
  const auto refuse_input = [&](const std::string& option, Parameter parameter) {
    if (!workflow.has_source(parameter))
      throw usage_error(option + " " + plain_name(parameter) +
                        ": has no effect, because this conversion reads no such input (remove this option)");
  };
  for (const auto& word : options.factors) refuse_input("--factor", word.parameter);
  for (const auto& [parameter, source] : options.inputs) {
    if (is_input(parameter) && !workflow.translation)
      throw usage_error(
          parameter_option(parameter) +
          ": requires openpbr or standard-surface as one of the two models (the other one can also be gltf "
          "or usd, or blender in --from; choose such models, or remove this option)");
    const bool is_used = parameter == Parameter::kOcclusion ||
                         (parameter == Parameter::kMetalMask && workflow.finds_metallic());
    if (!is_used) refuse_input("--input", parameter);
  }
}

// Refuses options of folders if there is only one set, and maps that cannot be used with a folder.
void require_one_way(const ConvertOptions& options, const ConversionChoice& workflow) {
  const bool is_tree = !options.folder.empty();
  if (!is_tree) refuse(options, kNeedsFolder, " requires a folder of sets (give DIR)");
  for (const Parameter parameter : {Parameter::kBaseColor, Parameter::kDiffuse})
    if (is_tree && !workflow.has_source(parameter) && options.map_of(parameter) != nullptr)
      throw usage_error(parameter_option(parameter) +
                        " cannot be used with a folder, because texremap copies the maps of the folder "
                        "(remove this option)");
  require_read(options, workflow);
  if (!is_tree && !workflow.translation) require_parameters(options, workflow);
}

// Keeps only numbers, because in a folder each set finds its own file.
void keep_numbers(const ConvertOptions& options, ParameterRequest& parameter) {
  if (!options.folder.empty() && std::holds_alternative<MapName>(parameter.source))
    parameter.source = MapName{};
}

}  // namespace

std::string one_channel(const std::string& option, const std::filesystem::path& file) {
  return file.empty() ? "" : option + " " + shell_word(file.string() + ":G");
}

namespace {

// Returns the value that a surface has for an input without a map.
ConstantValues default_of(const SurfaceTranslation& translation, Parameter parameter) {
  const auto inputs = inputs_of(translation.source);
  const auto found = std::ranges::find(inputs, std::optional(parameter), &SurfaceInput::parameter);
  return {found->value.begin(), found->value.begin() + static_cast<std::ptrdiff_t>(found->channels)};
}

// Returns the encoding of the roughness maps. `--roughness` never means glossiness.
std::optional<RoughnessEncoding> given_convention(const ConvertOptions& options,
                                                  const ConversionChoice& workflow) {
  if (options.reads_glossiness()) return RoughnessEncoding::kGlossiness;
  if (options.roughness_encoding) return options.roughness_encoding;
  if (!workflow.is_material()) return std::nullopt;
  const RoughnessEncoding own = width_of(*workflow.source);
  return own == RoughnessEncoding::kGlossiness ? RoughnessEncoding::kRoughness : own;
}

}  // namespace

TextureSetRequest set_request(const ConvertOptions& options, const ConversionChoice& workflow) {
  require_one_way(options, workflow);
  const std::map<Parameter, Transfer> transfers = color_spaces_read(options, workflow);
  TextureSetRequest request;
  std::vector<Parameter> parameters = workflow.sources();
  if (options.map_of(Parameter::kMetalMask) != nullptr) parameters.push_back(Parameter::kMetalMask);
  for (const Parameter parameter : parameters) {
    const bool is_width = parameter == Parameter::kRoughness;
    ParameterRequest asked;
    if (workflow.translation) asked.source = default_of(*workflow.translation, parameter);
    if (const MapSource* source = options.map_of(parameter)) asked.source = *source;
    if (const auto constant = workflow.constants.find(parameter); constant != workflow.constants.end())
      asked.source = constant->second;
    keep_numbers(options, asked);
    if (const auto* map = std::get_if<MapName>(&asked.source))
      asked.one_channel = one_channel(
          is_width && options.reads_glossiness() ? "--glossiness" : parameter_option(parameter), map->file);
    asked.factors = options.factors_of(parameter);
    if (const auto found = transfers.find(parameter); found != transfers.end())
      asked.transfer = found->second;
    request.parameters[parameter] = std::move(asked);
  }
  const auto carry = [&](Parameter parameter) {
    const MapSource* source = options.map_of(parameter);
    if (source == nullptr) return;
    ParameterRequest asked{*source, {}, Transfer::kLinear};
    keep_numbers(options, asked);
    if (const auto* map = std::get_if<MapName>(&asked.source); map != nullptr && map->file.empty()) return;
    request.carried.push_back({plain_name(parameter), std::move(asked)});
  };
  carry(Parameter::kOcclusion);
  if (!workflow.has_source(Parameter::kMetallic) && !workflow.is_to_metallic()) carry(Parameter::kMetallic);
  request.resample = options.resample;
  request.convention = given_convention(options, workflow);
  return request;
}

std::vector<CopiedFile> copied_files(const ConvertOptions& options, const ConversionChoice& workflow) {
  std::vector<CopiedFile> files;
  if (workflow.is_material()) return files;
  for (const Parameter parameter : {Parameter::kDiffuse, Parameter::kBaseColor}) {
    const MapSource* source = options.map_of(parameter);
    if (source == nullptr) continue;
    const auto* map = std::get_if<MapName>(source);
    if (map == nullptr || !map->channels.empty())
      throw usage_error(parameter_option(parameter) +
                        ": cannot be converted without a workflow (give a file to copy it, or use --from " +
                        (parameter == Parameter::kDiffuse ? "specular:" : "metallic:") + options.from.name +
                        ")");
    files.push_back({map->file, std::string(parameter_name(parameter)), ""});
  }
  return files;
}

CopiedFile copied_normals(const ConvertOptions& options, const std::filesystem::path& source) {
  const auto text = [](NormalGreen green) {
    return std::string(green == NormalGreen::kUp ? "OpenGL (green up)" : "DirectX (green down)");
  };
  const NamedLayout* const engine = options.engine;
  const std::string target(engine != nullptr ? engine->name : options.to.word());
  const auto wanted = engine != nullptr ? engine->normals : normals_of(options.to);
  const auto of_source = normals_of(options.from);
  const std::string from = "--from " + std::string(options.from.word());
  const std::string name = source.filename().string();
  const std::optional<NormalGreen> stated = stated_green(name);
  CopiedFile normals{source, "", ""};
  if (!wanted) {
    if (engine != nullptr) normals.reason = target + " reads both directions";
    return normals;
  }
  if (!stated && !of_source) {
    normals.reason = "neither the file name nor --from shows whether the map is OpenGL or DirectX; " +
                     target + " reads " + text(*wanted) +
                     " (add GL or DX to the name, such as wood_NormalGL.png)";
    return normals;
  }
  const NormalGreen green = stated ? *stated : *of_source;
  if (green == *wanted) {
    if (of_source && *of_source != green)
      normals.reason = "its name means " + text(green) + ", which " + target + " reads (maps of " + from +
                       " are " + text(*of_source) + ")";
    return normals;
  }
  std::filesystem::path turned = turned_name(name);
  std::error_code ignored;
  if (stated && std::filesystem::exists(source.parent_path() / turned, ignored)) return normals;
  normals.turned_name = turned.replace_extension(written_extension(turned)).string();
  normals.reason =
      (stated ? "its name" : from) + " means " + text(green) + ", but " + target + " reads " + text(*wanted);
  return normals;
}

namespace {

// Refuses an encoding of the results that their names contradict, or that no result uses.
void require_encoding(const ConvertOptions& options, const TargetChoice& choice) {
  const auto& asked = options.output_roughness.encoding;
  if (!asked) return;
  const std::optional<RoughnessEncoding> held = choice.layout.width();
  constexpr auto kGlossiness = RoughnessEncoding::kGlossiness;
  if (held && (*asked == kGlossiness) != (*held == kGlossiness))
    throw usage_error("--output-encoding " + std::string(encoding_name(*asked)) +
                      " cannot be used with --layout " + choice.layout.name + ", which stores " +
                      std::string(encoding_name(*held)) + " (use --layout separate)");
  if (options.only == Parameter::kSpecular)
    throw usage_error(
        "--output-encoding: has no effect, because --only specular writes no roughness (remove one of the "
        "two)");
}

}  // namespace

RoughnessEncoding written_width(const TargetChoice& choice, const TextureSet& set, RoughnessEncoding usual) {
  constexpr auto kGlossiness = RoughnessEncoding::kGlossiness, kRoughness = RoughnessEncoding::kRoughness;
  const std::optional<RoughnessEncoding> asked = choice.treatment.target_convention;
  const RoughnessEncoding wanted = asked.value_or(usual);
  if (const auto held = choice.layout.width()) {
    if (*held == kGlossiness) return kGlossiness;
    return wanted == kGlossiness ? kRoughness : wanted;
  }
  const SetParameter* const map = set.map_of(Parameter::kRoughness);
  if (!choice.layout.keeps_names || map == nullptr) return wanted;
  const bool is_glossy = set.convention == kGlossiness;
  if (asked && is_glossy != (*asked == kGlossiness))
    throw usage_error("--output-encoding " + std::string(encoding_name(*asked)) +
                      ": the result keeps the name " +
                      set.maps[map->channels.front().map].path().filename().string() + ", which means " +
                      (is_glossy ? "glossiness" : "roughness") + " (use --layout separate)");
  if (is_glossy) return kGlossiness;
  return wanted == kGlossiness ? kRoughness : wanted;
}

std::optional<std::filesystem::path> shared_map(const ConvertOptions& options,
                                                const std::filesystem::path& given) {
  std::error_code ignored;
  for (const std::filesystem::path& file : {given, options.folder / given})
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  return std::nullopt;
}

std::vector<std::filesystem::path> shared_maps(const ConvertOptions& options) {
  std::vector<std::filesystem::path> shared;
  const auto add = [&](const std::optional<MapSource>& source) {
    const auto* map = source ? std::get_if<MapName>(&*source) : nullptr;
    if (const auto file = map != nullptr ? shared_map(options, map->file) : std::nullopt)
      shared.push_back(*file);
  };
  if (options.folder.empty()) return shared;
  for (const auto& [parameter, source] : options.maps) add(source);
  return shared;
}

std::optional<TranslationEffect> effect_of(const ConversionChoice& workflow,
                                           const TextureSetRequest& request) {
  if (!workflow.translation) return std::nullopt;
  GivenInputs given;
  for (const auto& [parameter, asked] : request.parameters) {
    auto& values = given[parameter];
    if (const auto* constants = std::get_if<ConstantValues>(&asked.source)) values = *constants;
    if (values && !asked.factors.empty())
      for (std::size_t c = 0; c < values->size(); ++c)
        (*values)[c] *= asked.factors[asked.factors.size() == 1 ? 0 : c];
  }
  return effect_of(*workflow.translation, given);
}

void apply(const TranslationEffect& effect, TargetChoice& choice) {
  std::erase_if(choice.parameters, [&](Parameter parameter) {
    return !contains(effect.written, parameter) && choice.layout.file_with(parameter) == nullptr;
  });
  choice.unchanged = effect.unchanged;
  choice.wide = effect.wide;
}

TargetChoice target_choice(const ConvertOptions& options, const ConversionChoice& workflow) {
  TargetChoice choice;
  choice.treatment = {options.output_roughness.encoding,
                      static_cast<float>(options.output_roughness.white.value_or(1.0)),
                      options.bad_texels,
                      options.written_type == WrittenType::kDithered,
                      options.json,
                      options.json || !options.quiet};
  choice.folder = options.output;
  const bool is_other_kind = workflow.is_material() && kind_of(*workflow.source) != kind_of(*workflow.target);
  choice.layout = options.layout ? *options.layout
                  : is_other_kind || !workflow.constants.empty() || !shared_maps(options).empty()
                      ? separate()
                      : as_inputs();
  choice.extension = options.format;
  choice.type = options.type;
  choice.compression_level = options.compression.level;
  choice.diagnosis_folder = options.diagnose;
  if (!options.diagnose.empty()) {
    choice.diagnoses = {MaskChannel{}};
    if (workflow.finds_metallic())
      for (const Parameter measure :
           {Parameter::kResidual, Parameter::kMetallicUncertainty, Parameter::kMetallicIssues})
        choice.diagnoses.push_back(ConvertedChannel{measure});
  }
  choice.parameters = workflow.targets();
  choice.colors_stay_grey = !workflow.is_material();
  if (options.only) choice.parameters = {*options.only};
  if (workflow.changes_nothing) choice.unchanged = choice.parameters;
  choice.color_transfers = color_spaces("--output-color-space", options.output_color_spaces,
                                        colors_among(choice.parameters), "is written (remove this option)");
  require_encoding(options, choice);
  return choice;
}

}  // namespace remap
