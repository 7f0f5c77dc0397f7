#include "texture/target_plan.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>

#include "core/files.hpp"
#include "core/nearest_name.hpp"
#include "remap/error.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

void require_known_extension(const std::string& extension) {
  static const std::array<std::string, 9> kExtensions = {"exr",  "tif", "tiff", "png", "jpg",
                                                         "jpeg", "tga", "bmp",  "hdr"};
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end())
    throw Error(ErrorKind::kUsage,
                "--format: unknown format '" + extension + "'" + suggestion(extension, kExtensions));
}

fs::path result_path(fs::path name, const TargetChoice& choice) {
  if (!choice.extension.empty()) name.replace_extension(choice.extension);
  return choice.folder / name;
}

void require_safe(const fs::path& output, const fs::path& input) {
  if (same_file(output, input))
    throw Error(ErrorKind::kUsage, output.string() + ": would overwrite the input " + input.string() +
                                       " (choose another folder)");
}

void require_free(const fs::path& output, bool force) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(output, ignored);
  if (!fs::exists(status)) return;
  if (fs::is_directory(output, ignored))
    throw Error(ErrorKind::kOutput, output.string() + ": is a folder (choose another name)");
  if (!force) throw Error(ErrorKind::kOutput, output.string() + ": already exists (--force overwrites)");
}

void require_safe(const TargetPlan& plan, const TextureSet& set, const TargetChoice& choice) {
  std::error_code ignored;
  for (const fs::path& folder : {choice.folder, choice.diagnosis_folder})
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
      throw Error(ErrorKind::kOutput, folder.string() + ": is a file, not a folder");
  std::vector<fs::path> results;
  for (const PlannedMap& map : plan.maps) results.push_back(map.path);
  for (const PlannedCopy& copy : plan.copies) results.push_back(copy.path);
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (results[i] == results[k])
        throw Error(ErrorKind::kUsage,
                    results[i].string() + ": two results have this name (rename an input)");
    for (const ImageReader& map : set.maps) require_safe(results[i], map.path());
    for (const PlannedCopy& copy : plan.copies) require_safe(results[i], copy.source);
    require_free(results[i], choice.force);
  }
}

bool is_wanted(const TargetChoice& choice, Parameter parameter) {
  return std::find(choice.parameters.begin(), choice.parameters.end(), parameter) != choice.parameters.end();
}

// The content of a result's channel that follows `place` of a map.
TargetChannel content_of(const TextureSet& set, const ChannelPlace& place, const TargetChoice& choice) {
  std::optional<TargetChannel> content;
  std::optional<Parameter> held;
  for (const auto& [parameter, values] : set.parameters) {
    const auto found = std::find(values.channels.begin(), values.channels.end(), place);
    if (found == values.channels.end()) continue;
    const ImageReader& reader = set.maps[place.map];
    if (held)
      throw Error(ErrorKind::kUsage, reader.path().string() + ": channel " +
                                         reader.layout().channels[place.channel].name + " is used as both " +
                                         plain_name(*held) + " and " + plain_name(parameter) +
                                         " (choose channels with FILE:CHANNEL)");
    held = parameter;
    const auto index = static_cast<std::size_t>(found - values.channels.begin());
    if (is_wanted(choice, parameter)) content = ConvertedChannel{parameter, is_color(parameter) ? index : 0};
  }
  return content.value_or(place);
}

ImageChanges changes_of(const TargetChoice& choice) {
  ImageChanges changes;
  changes.type = choice.type;
  changes.metadata = choice.metadata;
  return changes;
}

const std::vector<std::string> kGrey = {"Y"}, kColor = {"R", "G", "B"}, kColorAndAlpha = {"R", "G", "B", "A"};

std::string own_name(const std::string& name, bool is_grey, const TextureSet& set,
                     const TargetChoice& choice) {
  std::string extension = choice.extension.empty() ? set.maps[set.first_map()].path().extension().string()
                                                   : "." + choice.extension;
  if (is_grey && extension == ".hdr") extension = ".exr";  // Radiance files have three channels
  return choice.names.before + name + choice.names.after + extension;
}

// The first color that is converted into one of the channels.
std::optional<Parameter> color_of(const std::vector<TargetChannel>& channels) {
  for (const TargetChannel& channel : channels)
    if (const auto* converted = std::get_if<ConvertedChannel>(&channel);
        converted != nullptr && is_color(converted->parameter))
      return converted->parameter;
  return std::nullopt;
}

// The parameter whose file a result follows: the same parameter, or a color that it is made from.
const SetParameter* model_of(const TextureSet& set, Parameter parameter) {
  if (const SetParameter* own = set.map_of(parameter)) return own;
  for (const Parameter other : {Parameter::kDiffuse, Parameter::kBaseColor, Parameter::kSpecular})
    if (const SetParameter* color = is_color(parameter) ? set.map_of(other) : nullptr) return color;
  return nullptr;
}

// Colors in whole numbers follow the map that they are made from.
ColorStorage color_storage(const TextureSet& set, Parameter parameter, const TargetChoice& choice) {
  ColorStorage storage;
  if (const auto chosen = choice.color_transfers.find(parameter); chosen != choice.color_transfers.end())
    storage.chosen = chosen->second;
  if (const SetParameter* model = model_of(set, parameter); model != nullptr && model->is_whole_numbers)
    storage.followed = model->transfer;
  return storage;
}

// A new map, for a parameter that is a constant in the set or is in another file there.
PlannedMap new_map(const std::string& name, const std::vector<std::string>& channel_names,
                   std::vector<TargetChannel> channels, const TextureSet& set, const TargetChoice& choice) {
  TargetPart part{set.first_map(), changes_of(choice), std::move(channels)};
  part.changes.channels = channel_names;
  return {choice.folder / own_name(name, channel_names.size() == 1, set, choice), {part}};
}

// Three channels, or one if the color is grey in the set and stays grey.
std::vector<TargetChannel> color_channels(const TextureSet& set, Parameter parameter,
                                          const TargetChoice& choice) {
  const auto found = set.parameters.find(parameter);
  const bool is_grey =
      choice.colors_stay_grey && found != set.parameters.end() && found->second.channel_count() == 1;
  std::vector<TargetChannel> channels;
  for (std::size_t c = 0; c < (is_grey ? 1u : 3u); ++c) channels.push_back(ConvertedChannel{parameter, c});
  return channels;
}

PlannedMap color_map(const TextureSet& set, Parameter parameter, const TargetChoice& choice) {
  std::vector<TargetChannel> channels = color_channels(set, parameter, choice);
  std::vector<std::string> names = channels.size() == 1 ? kGrey : kColor;
  const bool has_coverage = parameter == Parameter::kDiffuse || parameter == Parameter::kBaseColor;
  if (set.coverage && has_coverage) {
    channels.push_back(*set.coverage);
    names.push_back("A");
  }
  PlannedMap planned = new_map(file_name(parameter, choice), names, std::move(channels), set, choice);
  if (const SetParameter* model = model_of(set, parameter))
    planned.parts.front().model = model->channels.front().map;
  return planned;
}

TargetChannel carried_channel(const SetParameter& parameter) {
  if (parameter.is_map()) return parameter.channels.front();
  return parameter.constants.front();
}

// A channel of a packed map: the converted metallic, a carried parameter, or the constant `otherwise`.
TargetChannel packed_channel(const TextureSet& set, const std::string& name, float otherwise,
                             const TargetChoice& choice) {
  if (name == parameter_name(Parameter::kMetallic) && is_wanted(choice, Parameter::kMetallic))
    return ConvertedChannel{Parameter::kMetallic};
  for (const CarriedParameter& carried : set.carried)
    if (carried.name == name) return carried_channel(carried.parameter);
  return otherwise;
}

// Layouts other than kAsInputs hold named channels only, so an unnamed channel is an error and is not
// dropped.
void require_nothing_lost(const TextureSet& set) {
  for (std::size_t map = 0; map < set.maps.size(); ++map) {
    const ImageLayout& layout = set.maps[map].layout();
    for (std::size_t c = 0; c < layout.channels.size(); ++c) {
      if (set.holds({map, c}) || set.coverage == ChannelPlace{map, c}) continue;
      throw Error(ErrorKind::kUsage,
                  set.maps[map].path().string() + ": channel " + layout.channels[c].name +
                      " would be lost (name it with --occlusion or --metallic FILE:CHANNEL, "
                      "or use --layout as-inputs)");
    }
  }
}

// The maps of the set that are parts of the file of `first`, in the order of the file.
std::vector<std::size_t> parts_of_file(const TextureSet& set, std::size_t first) {
  std::vector<std::size_t> parts;
  for (std::size_t map = 0; map < set.maps.size(); ++map)
    if (map == first || same_file(set.maps[map].path(), set.maps[first].path())) parts.push_back(map);
  std::sort(parts.begin(), parts.end(),
            [&](std::size_t a, std::size_t b) { return set.maps[a].part() < set.maps[b].part(); });
  return parts;
}

// Adds a copy unless a file of this name is already written or copied.
void add_copy(const fs::path& source, const fs::path& path, TargetPlan& plan) {
  const auto is_there = [&](const auto& result) { return result.path == path; };
  if (std::any_of(plan.maps.begin(), plan.maps.end(), is_there) ||
      std::any_of(plan.copies.begin(), plan.copies.end(), is_there))
    return;
  std::error_code ignored;
  if (!fs::is_regular_file(source, ignored))
    throw Error(ErrorKind::kInput, source.string() + ": cannot be copied: not a readable file");
  plan.copies.push_back({source, path});
}

// A file that holds one parameter.
PlannedMap own_map(const TextureSet& set, Parameter parameter, const TargetChoice& choice) {
  if (is_color(parameter)) return color_map(set, parameter, choice);
  return new_map(file_name(parameter, choice), kGrey, {ConvertedChannel{parameter}}, set, choice);
}

// The color of a file with one grey channel and nothing else, if the result must have three channels.
std::optional<Parameter> grey_alone(const PlannedMap& planned, const TargetChoice& choice) {
  if (choice.colors_stay_grey || planned.parts.size() != 1) return std::nullopt;
  const std::vector<TargetChannel>& channels = planned.parts.front().channels;
  return channels.size() == 1 ? color_of(channels) : std::nullopt;
}

TargetPlan maps_as_inputs(const TextureSet& set, const TargetChoice& choice) {
  TargetPlan plan;
  std::vector<bool> seen(set.maps.size());
  for (std::size_t first = 0; first < set.maps.size(); ++first) {
    if (seen[first]) continue;
    PlannedMap planned{result_path(set.maps[first].path().filename(), choice), {}};
    bool holds_something = false;
    for (const std::size_t map : parts_of_file(set, first)) {
      seen[map] = true;
      TargetPart part{map, changes_of(choice), {}};
      for (std::size_t c = 0; c < set.maps[map].layout().channels.size(); ++c)
        part.channels.push_back(content_of(set, {map, c}, choice));
      const bool is_changed = std::any_of(part.channels.begin(), part.channels.end(), is_converted);
      if (!is_changed) part.changes.type = std::nullopt;  // an unchanged part keeps its type
      holds_something = holds_something || is_changed;
      planned.parts.push_back(std::move(part));
    }
    if (const auto color = grey_alone(planned, choice))
      planned = {planned.path, color_map(set, *color, choice).parts};
    if (holds_something) plan.maps.push_back(std::move(planned));
  }
  for (const Parameter parameter : choice.parameters) {
    if (set.map_of(parameter) != nullptr) continue;
    if (set.parameters.count(parameter) == 0)
      throw Error(ErrorKind::kUsage, "--layout as-inputs: no input holds " +
                                         std::string(parameter_name(parameter)) +
                                         " (use separate, orm, arm or specgloss)");
    plan.maps.push_back(own_map(set, parameter, choice));
  }
  for (const CarriedParameter& carried : set.carried) {
    if (!carried.parameter.is_map())
      throw Error(ErrorKind::kUsage, "--" + carried.name +
                                         ": a number has no place in --layout as-inputs (give a map, or use "
                                         "another layout)");
    const fs::path& source = set.maps[carried.parameter.channels.front().map].path();
    const auto is_written = [&](const PlannedMap& map) {
      return same_file(set.maps[map.parts.front().model].path(), source);
    };
    if (std::none_of(plan.maps.begin(), plan.maps.end(), is_written))
      add_copy(source, choice.folder / source.filename(), plan);
  }
  return plan;
}

PlannedMap carried_map(const TextureSet& set, const CarriedParameter& carried, const TargetChoice& choice) {
  PlannedMap map = new_map(carried.name, kGrey, {carried_channel(carried.parameter)}, set, choice);
  if (carried.parameter.is_map()) map.parts.front().model = carried.parameter.channels.front().map;
  return map;
}

std::vector<PlannedMap> separate_maps(const TextureSet& set, const TargetChoice& choice) {
  std::vector<PlannedMap> all;
  for (const Parameter parameter : choice.parameters) all.push_back(own_map(set, parameter, choice));
  for (const CarriedParameter& carried : set.carried) all.push_back(carried_map(set, carried, choice));
  return all;
}

std::vector<PlannedMap> specgloss_maps(const TextureSet& set, const TargetChoice& choice) {
  std::vector<TargetChannel> channels = color_channels(set, Parameter::kSpecular, choice);
  channels.resize(3, channels.front());  // grey in every color
  channels.push_back(ConvertedChannel{Parameter::kRoughness});
  std::vector<PlannedMap> all = {
      new_map(file_name(Parameter::kSpecular, choice), kColorAndAlpha, channels, set, choice)};
  if (is_wanted(choice, Parameter::kDiffuse)) all.push_back(color_map(set, Parameter::kDiffuse, choice));
  for (const CarriedParameter& carried : set.carried) all.push_back(carried_map(set, carried, choice));
  return all;
}

std::vector<PlannedMap> packed_maps(const TextureSet& set, const TargetChoice& choice) {
  const std::string layout(name_of(kLayouts, choice.layout));
  const bool is_specgloss = choice.layout == Layout::kSpecGloss;
  const bool is_metallic = is_wanted(choice, Parameter::kMetallic);
  if (is_specgloss ? is_metallic : is_wanted(choice, Parameter::kDiffuse))
    throw Error(ErrorKind::kUsage, "--layout: " + layout + " cannot hold " +
                                       (is_specgloss ? "metallic (use separate or orm)"
                                                     : "diffuse and specular (use separate or specgloss)"));
  if (!is_wanted(choice, Parameter::kRoughness) || (is_specgloss && !is_wanted(choice, Parameter::kSpecular)))
    throw Error(ErrorKind::kUsage,
                "--only cannot be used with --layout " + layout + " (a channel would be empty)");
  if (is_specgloss) return specgloss_maps(set, choice);
  std::vector<PlannedMap> all = {
      new_map(file_name(Parameter::kRoughness, choice), kColor,
              {packed_channel(set, "occlusion", 1.0f, choice), ConvertedChannel{Parameter::kRoughness},
               packed_channel(set, "metallic", 0.0f, choice)},
              set, choice)};
  for (const Parameter parameter : choice.parameters)
    if (is_color(parameter)) all.push_back(color_map(set, parameter, choice));
  return all;
}

}  // namespace

std::string file_name(Parameter parameter, const TargetChoice& choice) {
  const bool is_width = parameter == Parameter::kRoughness;
  if (choice.layout == Layout::kSpecGloss && (is_width || parameter == Parameter::kSpecular))
    return "specular_glossiness";
  if ((choice.layout == Layout::kOrm || choice.layout == Layout::kArm) &&
      (is_width || parameter == Parameter::kMetallic))
    return std::string(name_of(kLayouts, choice.layout));
  return is_width ? choice.width_name : std::string(parameter_name(parameter));
}

std::string diagnosis_name(const TargetChannel& diagnosis) {
  const auto* measure = std::get_if<ConvertedChannel>(&diagnosis);
  return measure == nullptr ? "mask" : std::string(parameter_name(measure->parameter));
}

TargetPlan plan_targets(const TextureSet& set, const TargetChoice& choice) {
  if (!choice.extension.empty()) require_known_extension(choice.extension);
  TargetPlan plan;
  if (choice.layout == Layout::kAsInputs) {
    plan = maps_as_inputs(set, choice);
  } else {
    require_nothing_lost(set);
    plan.maps = choice.layout == Layout::kSeparate ? separate_maps(set, choice) : packed_maps(set, choice);
  }
  for (const TargetChannel& diagnosis : choice.diagnoses) {
    plan.maps.push_back(new_map(diagnosis_name(diagnosis), kGrey, {diagnosis}, set, choice));
    fs::path& path = plan.maps.back().path;
    path = choice.diagnosis_folder / path.filename();
  }
  for (PlannedMap& map : plan.maps)
    for (TargetPart& part : map.parts)
      if (const auto color = color_of(part.channels))
        part.changes.colors = color_storage(set, *color, choice);
  for (const CopiedFile& file : choice.copies) {
    const bool keeps_name = file.name.empty() || choice.layout == Layout::kAsInputs;
    const std::string name =
        keeps_name ? file.source.filename().string()
                   : choice.names.before + file.name + choice.names.after + file.source.extension().string();
    add_copy(file.source, choice.folder / name, plan);
  }
  require_safe(plan, set, choice);
  return plan;
}

std::vector<TargetMap> open_targets(const TextureSet& set, const TargetPlan& plan) {
  std::vector<TargetMap> targets;
  for (const PlannedMap& map : plan.maps) {
    create_parent(map.path);
    std::vector<NewPart> parts;
    for (const TargetPart& part : map.parts) parts.push_back({&set.maps[part.model].stored(), part.changes});
    targets.push_back({image_library().create(map.path, parts), map.parts});
  }
  return targets;
}

}  // namespace remap
