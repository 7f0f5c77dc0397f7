#include "texremap/plan/workflow_choice.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/errors.hpp"
#include "sets/naming.hpp"

namespace remap {
namespace {

// Returns the words of the command line.
ConversionWords option_words() { return {"--from", "--to", "--via", "--dielectric-f0", "texremap list"}; }

void require_estimable(const ConversionChoice& choice) {
  if (kind_of(*choice.source) == WorkflowKind::kSpecular && choice.is_to_metallic()) return;
  throw usage_error(
      "--dielectric-f0: estimate requires maps of the specular workflow and a metallic target (give a "
      "number)");
}

// Refuses options that require a workflow, or a target with metallic.
void require_workflow(const ConvertOptions& options, const ConversionChoice& choice) {
  if (choice.is_material())
    refuse(options, kNotWithWorkflow,
           " cannot be used, because this conversion changes the maps of a material together (remove this "
           "option)");
  else
    refuse(options, kNeedsWorkflow | kNeedsMetallic,
           " requires a workflow (write one before the model, such as --from specular:mitsuba/ward, or "
           "choose a model of texremap list --workflows)");
  if (choice.translation)
    refuse(options, kNeedsMetallic,
           ": has no effect, because formulas convert every input between these models (remove this option)");
  if (choice.changes_nothing)
    refuse(options, kNeedsMetallic,
           ": has no effect, because source and target have the same material model (remove this option)");
  if (!choice.is_to_metallic())
    refuse(options, kNeedsMetallic,
           " requires a metallic target (choose another --to, such as gltf or metallic:mitsuba/ggx)");
}

}  // namespace

ConversionChoice workflow_choice(const ConvertOptions& options) {
  const auto* const f0 = std::get_if<double>(&options.dielectric_f0);
  ConversionRequest request;
  request.source = options.from;
  request.target = options.to;
  request.via = options.via;
  request.prior = options.prior;
  request.translates_surfaces = true;
  request.words = option_words();
  if (f0 != nullptr) request.dielectric_f0 = *f0;
  ConversionChoice choice = choose_conversion(request, options.converters.graph());
  if (choice.is_material() && options.dielectric_f0 == F0Choice(F0Source::kMaps)) require_estimable(choice);
  require_workflow(options, choice);
  return choice;
}

namespace {

void refuse_with_warp(const ConvertOptions& options, OptionTags tag, const std::string& warp) {
  refuse(options, tag, " cannot be used with the warp " + warp + " (remove this option)");
}

// Handles a warp whose source is only a diffuse map. It has neither specular nor roughness maps.
void choose_diffuse_alone(const ConvertOptions& options, ConversionChoice& choice) {
  const std::string warp = options.converters.path().string();
  refuse_with_warp(options, kNotWithDiffuseWarp, warp + ", which converts only a diffuse map");
  if (kind_of(*choice.source) == WorkflowKind::kMetallic)
    throw usage_error("--from metallic:" + options.from.name + ": " + warp +
                      " converts only a diffuse map (remove this option)");
  std::get<SpecularWorkflow>(*choice.source).width = RoughnessEncoding::kAlpha;
  choice.constants = {{Parameter::kSpecular, {0.0f}}, {Parameter::kRoughness, {1.0f}}};
}

}  // namespace

void require_model_of_fit(const std::string& file, const std::string& option, const std::string& asked,
                          const std::string& own) {
  if (!asked.empty() && asked != own)
    throw usage_error(file + ": " + (option == "--from" ? "source" : "target") + " model is " + own +
                      ", but " + option + " asks for " + asked + " (remove " + option + ")");
}

void refuse_diffuse(const ConvertOptions& options, const std::string& reason) {
  for (const ModelName* model : {&options.from, &options.to})
    if (model->diffuse)
      throw usage_error(prefixes_of(*model) + model->name + ": " + reason + "remove " +
                        std::string(diffuse_convention_name(*model->diffuse)) + ":)");
}

ConversionChoice workflow_of_warp(const ConvertOptions& options, const WarpMapFit& fit) {
  const std::string warp = options.converters.path().string();
  refuse_with_warp(options, kNotWithWarp, warp);
  require_model_of_fit(warp, "--from", options.from.name, fit.source_model);
  require_model_of_fit(warp, "--to", options.to.name, fit.template_model);
  refuse_diffuse(options,
                 "maps of the warp " + warp + " always have plain diffuse (a prefix cannot choose it; ");
  if (options.to.workflow)
    throw usage_error("--to: results of the warp " + warp +
                      " have the specular workflow (remove this option)");
  // The warp was made from maps of roughness.
  const RoughnessEncoding width = options.reads_glossiness()
                                      ? RoughnessEncoding::kGlossiness
                                      : options.roughness_encoding.value_or(RoughnessEncoding::kRoughness);
  // `remapc warp` reads metallic sets in the same way.
  ConversionChoice choice =
      choice_of_warp(fit, options.from.workflow.value_or(WorkflowKind::kSpecular), width);
  if (is_of_diffuse_alone(fit)) choose_diffuse_alone(options, choice);
  require_workflow(options, choice);
  return choice;
}

namespace {

std::string use_text(const FoundSet& set, const MapUse& use) {
  std::string text = display_path(set.maps[use.map].path.filename());
  if (use.channels != Channels::kWhole) text += ":" + std::string(name_of(kChannels, use.channels));
  return text;
}

// Returns true if a word names a role, or a part of a file name between separators.
bool names(const std::string& word, const FoundSet& set, const MapUse& use) {
  const std::string wanted = lower(word);
  if (wanted == role_name(use.role) || (wanted == "gloss" && use.role == Role::kGlossiness)) return true;
  const std::string file = lower(set.maps[use.map].path.filename().string());
  return std::ranges::any_of(name_pieces(file),
                             [&](const NamePiece& piece) { return piece.in(file) == wanted; });
}

template <typename Wanted>
std::vector<MapUse> those(const std::vector<MapUse>& found, Wanted wanted) {
  std::vector<MapUse> kept;
  std::ranges::copy_if(found, std::back_inserter(kept), wanted);
  return kept;
}

// A KeptUse is the only map that is kept for a parameter, with the reason. The reason is empty if the user
// asked for this map.
struct KeptUse {
  MapUse use;
  std::string reason;
};
std::optional<KeptUse> kept_of(const FoundSet& set, std::vector<MapUse> found,
                               const std::vector<std::string>& prefer, std::optional<RoughnessEncoding> own) {
  for (const std::string& word : prefer)
    if (const auto named = those(found, [&](const MapUse& use) { return names(word, set, use); });
        !named.empty())
      found = named;
  if (found.size() == 1) return KeptUse{found.front(), ""};
  const auto is_own = [&](const MapUse& use) {
    return encoding_of(use.role).value_or(RoughnessEncoding::kRoughness) == *own;
  };
  if (own && is_roughness(found.front().role))
    if (const auto same = those(found, is_own); !same.empty()) found = same;
  if (found.size() == 1) return KeptUse{found.front(), "the parameter of the model"};
  const auto whole = those(found, [](const MapUse& use) {
    return use.channels == Channels::kWhole || use.channels == Channels::kRgb;
  });
  if (whole.size() == 1) return KeptUse{whole.front(), "a separate map"};
  const auto role_count = [&](const MapUse& use) { return set.maps[use.map].meaning.size(); };
  std::size_t most = 0;
  for (const MapUse& use : found) most = std::max(most, role_count(use));
  const auto fullest = those(found, [&](const MapUse& use) { return role_count(use) == most; });
  if (fullest.size() == 1) return KeptUse{fullest.front(), "which contains more of the material"};
  return std::nullopt;
}

void drop(FoundSet& set, const MapUse& use) {
  FoundMap& map = set.maps[use.map];
  std::erase_if(map.meaning, [&](const ChannelMeaning& entry) {
    return entry.channels == use.channels && entry.role == use.role;
  });
  map.is_repeated = true;
  map.is_converted = std::ranges::any_of(map.meaning, [](const ChannelMeaning& entry) {
    return is_roughness(entry.role) || entry.role == Role::kSpecular;
  });
}

// Returns the source model whose maps these are, or an empty text.
std::string model_of_maps(bool metallic, bool base_color, bool specular, bool glossiness, bool diffuse) {
  if (metallic || (base_color && !specular)) return "metallic";
  if (specular && glossiness) return "gltf-specgloss";
  if (specular && (diffuse || base_color)) return "specular";
  return "";
}

std::string model_of_set(const FoundSet& set) {
  return model_of_maps(!uses(set, is<Role::kMetallic>).empty(), !uses(set, is<Role::kBaseColor>).empty(),
                       !uses(set, is<Role::kSpecular>).empty(), !uses(set, is<Role::kGlossiness>).empty(),
                       !uses(set, is<Role::kDiffuse>).empty());
}

}  // namespace

namespace {

// These roles are also inputs of surfaces.
constexpr std::array<std::pair<Role, std::string_view>, 2> kRolesOfInputs = {
    {{Role::kIor, "ior"}, {Role::kTransmission, "transmission_weight"}}};

std::vector<MapUse> uses_of_input(const FoundSet& set, Parameter parameter) {
  std::vector<MapUse> found;
  const auto holds = [&](const ChannelMeaning& entry) {
    return entry.input == parameter || std::ranges::any_of(kRolesOfInputs, [&](const auto& role) {
             return role.first == entry.role && role.second == parameter_name(parameter);
           });
  };
  for (std::size_t i = 0; i < set.maps.size(); ++i)
    for (const ChannelMeaning& entry : set.maps[i].meaning)
      if (holds(entry)) found.push_back({i, entry.channels, entry.role});
  return found;
}

}  // namespace

std::vector<MapUse> uses_of(const FoundSet& set, Parameter parameter) {
  const auto either = [](std::vector<MapUse> best, std::vector<MapUse> other) {
    return best.empty() ? other : best;
  };
  switch (parameter) {
    case Parameter::kRoughness:
      return uses(set, is_roughness);
    case Parameter::kSpecular:
      return uses(set, is<Role::kSpecular>);
    case Parameter::kDiffuse:
      return either(uses(set, is<Role::kDiffuse>), uses(set, is<Role::kBaseColor>));
    case Parameter::kBaseColor:
      return either(uses(set, is<Role::kBaseColor>), uses(set, is<Role::kDiffuse>));
    case Parameter::kMetallic:
      return uses(set, is<Role::kMetallic>);
    default:
      return uses_of_input(set, parameter);
  }
}

std::vector<std::string> choose_maps(FoundSet& set, const std::vector<Parameter>& parameters,
                                     const std::vector<std::string>& prefer,
                                     std::optional<RoughnessEncoding> own) {
  std::vector<std::string> notes;
  for (const Parameter parameter : parameters) {
    const std::vector<MapUse> found = uses_of(set, parameter);
    if (found.size() < 2) continue;
    const std::optional<KeptUse> kept = kept_of(set, found, prefer, own);
    if (!kept) continue;
    std::string others;
    for (const MapUse& use : found) {
      if (use.map == kept->use.map && use.channels == kept->use.channels) continue;
      others += (others.empty() ? "" : ", ") + use_text(set, use);
      drop(set, use);
    }
    if (!kept->reason.empty())
      notes.push_back(plain_name(parameter) + " is read from " + use_text(set, kept->use) + ", " +
                      kept->reason + ", not from " + others + " (--prefer changes that)");
  }
  judge(set);
  return notes;
}

namespace {

bool has_subfolder(const std::filesystem::path& folder) {
  std::error_code failure;
  const std::filesystem::directory_iterator begin(folder, failure), end;
  return !failure && std::any_of(begin, end, [](const auto& entry) {
    std::error_code ignored;
    return entry.is_directory(ignored);
  });
}

}  // namespace

std::string infer_source(ConvertOptions& options, const std::optional<Discovery>& sets) {
  const auto has = [&](Parameter parameter) { return options.map_of(parameter) != nullptr; };
  std::string model =
      model_of_maps(has(Parameter::kMetallic), has(Parameter::kBaseColor), has(Parameter::kSpecular),
                    options.reads_glossiness(), has(Parameter::kDiffuse));
  if (!sets) {
    const auto is_given = [](const auto& map) { return map.second.has_value(); };
    if (std::ranges::none_of(options.maps, is_given))
      throw usage_error(
          "no folder and no maps given (for example: texremap convert FOLDER --to unity -o out)");
    if (model.empty())
      throw usage_error(
          "--from is required, because the maps do not identify the source (texremap list shows the models)");
    options.from = model_name().read("--from", model);
    return "texremap uses --from " + model + ", the model that has these maps";
  }
  std::string first;
  std::size_t count = 0;
  for (const FoundSet& set : sets->sets) {
    const std::string inferred = model_of_set(set);
    if (inferred.empty()) continue;
    const std::string context = display_path(set.folder / set.name);
    if (!first.empty() && inferred != model)
      throw usage_error("--from is required, because the sets differ: " + first + " uses the model " + model +
                        ", " + context + " uses " + inferred +
                        " (convert the sets of each model separately)");
    if (first.empty()) first = context;
    model = inferred;
    ++count;
  }
  if (sets->sets.empty() && !options.recursive && has_subfolder(options.folder))
    throw usage_error(display_path(options.folder) +
                      ": contains no maps, only folders (add --recursive to convert these folders)");
  if (first.empty())
    throw usage_error(
        "--from is required, because the file names do not identify the source (texremap list shows the "
        "models)");
  options.from = model_name().read("--from", model);
  return "texremap uses --from " + model + ", detected from the maps of " +
         (count == 1 ? first : std::to_string(count) + " sets");
}

}  // namespace remap
