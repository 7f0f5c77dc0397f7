#include "texture/target_plan.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace fs = std::filesystem;

// Returns PNG for WebP inputs, because PNG is lossless and has more than 8 bits.
std::string written_extension(const fs::path& input) {
  const std::string extension = input.extension().string();
  return extension == ".webp" ? ".png" : extension;
}

namespace {

void require_known_extension(const std::string& extension) {
  static const std::array<std::string, 9> kExtensions = {"exr",  "tif", "tiff", "png", "jpg",
                                                         "jpeg", "tga", "bmp",  "hdr"};
  if (!contains(kExtensions, extension))
    throw usage_error("--format: unknown format '" + extension + "'" + suggestion(extension, kExtensions));
}

fs::path result_path(fs::path name, const TargetChoice& choice) {
  name.replace_extension(choice.extension.empty() ? written_extension(name) : choice.extension);
  return choice.folder / name;
}

void require_safe(const fs::path& output, const fs::path& input) {
  if (same_file(output, input))
    throw usage_error(output.string() + ": would overwrite the input " + input.string() +
                      " (choose another folder)");
}

void require_safe(const TargetPlan& plan, const TextureSet& set, const TargetChoice& choice) {
  std::error_code ignored;
  for (const fs::path& folder : {choice.folder, choice.diagnosis_folder})
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
      throw output_error(folder.string() + ": is a file, not a folder (choose another folder)");
  std::vector<fs::path> results;
  for (const PlannedFile& map : plan.maps) results.push_back(map.path);
  for (const PlannedFile& copy : plan.copies) results.push_back(copy.path);
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (results[i] == results[k])
        throw usage_error(results[i].string() + ": two results have this name (rename an input" +
                          (choice.diagnosis_folder.empty() ? ")" : ", or give --diagnose another folder)"));
    for (const ImageReader& map : set.maps) require_safe(results[i], map.path());
    for (const PlannedFile& copy : plan.copies) require_safe(results[i], copy.source);
  }
}

bool is_wanted(const TargetChoice& choice, Parameter parameter) {
  return contains(choice.parameters, parameter);
}

// Returns what a channel of a result holds if the result is made from `place`, a channel of an input map.
TargetChannel content_of(const TextureSet& set, const ChannelPlace& place, const TargetChoice& choice) {
  std::optional<TargetChannel> content;
  std::optional<Parameter> held;
  for (const auto& [parameter, values] : set.parameters) {
    const auto found = std::ranges::find(values.channels, place);
    if (found == values.channels.end()) continue;
    const ImageReader& reader = set.maps[place.map];
    if (held)
      throw usage_error(reader.path().string() + ": channel " +
                        plain(reader.layout().channels[place.channel].name) + " is used as both " +
                        plain_name(*held) + " and " + plain_name(parameter) +
                        " (choose another channel for one of them, such as orm.png:G)");
    held = parameter;
    const auto index = static_cast<std::size_t>(found - values.channels.begin());
    if (is_wanted(choice, parameter)) content = ConvertedChannel{parameter, is_color(parameter) ? index : 0};
  }
  return content.value_or(place);
}

ImageChanges changes_of(const TargetChoice& choice) {
  ImageChanges changes;
  changes.type = choice.type;
  changes.compression_level = choice.compression_level;
  changes.metadata = choice.metadata;
  return changes;
}

const std::vector<std::string> kGrey = {"Y"}, kColor = {"R", "G", "B"}, kColorAndAlpha = {"R", "G", "B", "A"};

// Returns the name of a result. If `pattern` has a `*`, the set's name replaces it. Otherwise, the set's name
// comes first.
std::string named(const std::string& pattern, const ResultNames& names) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos)
    return (names.set.empty() ? pattern : names.set + "_" + pattern) + names.after;
  if (!names.set.empty()) return pattern.substr(0, star) + names.set + pattern.substr(star + 1) + names.after;
  std::string before = pattern.substr(0, star), rest = pattern.substr(star + 1);
  if (rest.starts_with('_')) rest.erase(0, 1);
  return before + rest + names.after;
}

std::string own_name(const std::string& name, bool is_grey, const TextureSet& set,
                     const TargetChoice& choice) {
  std::string extension =
      choice.extension.empty() ? written_extension(set.maps[set.first_map()].path()) : "." + choice.extension;
  if (is_grey && extension == ".hdr") extension = ".exr";  // Radiance files have three channels
  return name + extension;
}

// Returns the first color that is converted into one of the channels.
std::optional<Parameter> color_of(const std::vector<TargetChannel>& channels) {
  for (const TargetChannel& channel : channels)
    if (const auto* converted = std::get_if<ConvertedChannel>(&channel);
        converted != nullptr && is_color(converted->parameter))
      return converted->parameter;
  return std::nullopt;
}

// Returns the parameter whose file is the model of a result: the same parameter, or a color that the result
// is made from.
const SetParameter* model_of(const TextureSet& set, Parameter parameter) {
  if (const SetParameter* own = set.map_of(parameter)) return own;
  for (const Parameter other : {Parameter::kDiffuse, Parameter::kBaseColor, Parameter::kSpecular})
    if (const SetParameter* color = is_color(parameter) ? set.map_of(other) : nullptr) return color;
  return nullptr;
}

// Returns how a color is stored. Colors in integers have the curve of the map that they are made from.
ColorStorage color_storage(const TextureSet& set, Parameter parameter, const TargetChoice& choice) {
  ColorStorage storage;
  if (const auto chosen = choice.color_transfers.find(parameter); chosen != choice.color_transfers.end())
    storage.chosen = chosen->second;
  if (const SetParameter* model = model_of(set, parameter); model != nullptr && model->is_whole_numbers)
    storage.followed = model->transfer;
  return storage;
}

// Returns a new map for a parameter that has no separate file in the set.
PlannedFile new_map(const std::string& name, const std::vector<std::string>& channel_names,
                    std::vector<TargetChannel> channels, const TextureSet& set, const TargetChoice& choice) {
  TargetPart part{set.first_map(), changes_of(choice), std::move(channels)};
  part.changes.channels = channel_names;
  return {choice.folder / own_name(name, channel_names.size() == 1, set, choice), {part}};
}

// Returns three channels, or one if the color is grey in the set and stays grey.
std::vector<TargetChannel> color_channels(const TextureSet& set, Parameter parameter,
                                          const TargetChoice& choice) {
  const auto found = set.parameters.find(parameter);
  const bool is_grey =
      choice.colors_stay_grey && found != set.parameters.end() && found->second.channel_count() == 1;
  std::vector<TargetChannel> channels;
  for (std::size_t c = 0; c < (is_grey ? 1u : 3u); ++c) channels.push_back(ConvertedChannel{parameter, c});
  return channels;
}

PlannedFile color_map(const TextureSet& set, Parameter parameter, const TargetChoice& choice) {
  std::vector<TargetChannel> channels = color_channels(set, parameter, choice);
  std::vector<std::string> names = channels.size() == 1 ? kGrey : kColor;
  const bool has_coverage = parameter == Parameter::kDiffuse || parameter == Parameter::kBaseColor;
  if (set.coverage && has_coverage) {
    channels.push_back(*set.coverage);
    names.push_back("A");
  }
  PlannedFile planned =
      new_map(file_name(parameter, choice, choice.names), names, std::move(channels), set, choice);
  if (const SetParameter* model = model_of(set, parameter))
    planned.parts.front().model = model->channels.front().map;
  return planned;
}

TargetChannel carried_channel(const SetParameter& parameter) {
  if (parameter.is_map()) return parameter.channels.front();
  return parameter.constants.front();
}

// Returns the channels that hold one parameter, or a constant if the parameter is missing.
std::vector<TargetChannel> channels_of(const LayoutContent& content, const TextureSet& set,
                                       const TargetChoice& choice) {
  if (const auto* number = std::get_if<float>(&content)) return {*number};
  const auto carried = [&](const std::string& name, float otherwise) -> std::vector<TargetChannel> {
    for (const Carried<SetParameter>& parameter : set.carried)
      if (parameter.name == name) return {carried_channel(parameter.parameter)};
    return {otherwise};
  };
  if (const auto* other = std::get_if<std::string>(&content)) return carried(*other, 1.0f);
  const Parameter parameter = std::get<LayoutParameter>(content).parameter;
  if (parameter == Parameter::kMetallic && !is_wanted(choice, parameter))
    return carried(std::string(parameter_name(parameter)), 0.0f);
  if (!is_color(parameter)) return {ConvertedChannel{parameter}};
  std::vector<TargetChannel> channels = color_channels(set, parameter, choice);
  channels.resize(3, channels.front());  // grey becomes three equal channels
  return channels;
}

// Returns true if a file of the layout would hold any value of the set. Other files are not written.
bool holds_something(const LayoutFile& file, const TextureSet& set, const TargetChoice& choice) {
  return std::ranges::any_of(file.content, [&](const LayoutContent& content) {
    if (const auto* own = std::get_if<LayoutParameter>(&content)) return is_wanted(choice, own->parameter);
    const auto* other = std::get_if<std::string>(&content);
    return other != nullptr && std::ranges::any_of(set.carried, [&](const Carried<SetParameter>& carried) {
             return carried.name == *other;
           });
  });
}

// Returns messages about channels that no result has. Layouts with named files have no place for them.
std::vector<std::string> unplaced(const TextureSet& set) {
  std::vector<std::string> messages;
  for (std::size_t map = 0; map < set.maps.size(); ++map) {
    const ImageLayout& layout = set.maps[map].layout();
    std::vector<std::string> names;
    for (std::size_t c = 0; c < layout.channels.size(); ++c)
      if (!set.holds({map, c}) && set.coverage != ChannelPlace{map, c})
        names.push_back(layout.channels[c].name);
    if (names.empty()) continue;
    const bool is_one = names.size() == 1;
    messages.push_back(set.maps[map].path().string() + (is_one ? ": channel " : ": channels ") +
                       joined(names, ", ") + (is_one ? " is not used and is" : " are not used and are") +
                       " skipped (--layout as-inputs keeps " + (is_one ? "it)" : "them)"));
  }
  return messages;
}

// Returns the maps of the set that are parts of the same file as `first`, in the order of the file.
std::vector<std::size_t> parts_of_file(const TextureSet& set, std::size_t first) {
  std::vector<std::size_t> parts;
  for (std::size_t map = 0; map < set.maps.size(); ++map)
    if (map == first || same_file(set.maps[map].path(), set.maps[first].path())) parts.push_back(map);
  std::ranges::sort(parts,
                    [&](std::size_t a, std::size_t b) { return set.maps[a].part() < set.maps[b].part(); });
  return parts;
}

// Adds a copy, unless the plan already writes or copies a file of this name.
void add_copy(const fs::path& source, const fs::path& path, TargetPlan& plan, bool turns_green = false) {
  const auto is_there = [&](const auto& result) { return result.path == path; };
  if (std::ranges::any_of(plan.maps, is_there) || std::ranges::any_of(plan.copies, is_there)) return;
  std::error_code ignored;
  if (!fs::is_regular_file(source, ignored))
    throw input_error(source.string() +
                      ": cannot be copied, because it is not a readable file (check the path)");
  plan.copies.push_back({path, {}, source, turns_green});
}

// Returns true if the chosen type and format can hold values above 1.
bool holds_floats(const TargetChoice& choice) {
  const bool is_float_type = choice.type == PixelType::kHalf || choice.type == PixelType::kFloat;
  return choice.extension == "hdr" ||
         (is_float_type && (choice.extension == "exr" || choice.extension.starts_with("tif")));
}

PlannedFile own_map(const TextureSet& set, Parameter parameter, const TargetChoice& choice) {
  const bool is_wide = contains(choice.wide, parameter);
  if (is_wide && !holds_floats(choice)) {
    TargetChoice floats = choice;
    floats.extension = "exr";
    floats.type = PixelType::kHalf;
    return own_map(set, parameter, floats);
  }
  if (is_color(parameter)) return color_map(set, parameter, choice);
  return new_map(file_name(parameter, choice, choice.names), kGrey, {ConvertedChannel{parameter}}, set,
                 choice);
}

// Returns the color of a file with one grey channel and nothing else, if the result must have three channels.
std::optional<Parameter> grey_alone(const PlannedFile& planned, const TargetChoice& choice) {
  if (choice.colors_stay_grey || planned.parts.size() != 1) return std::nullopt;
  const std::vector<TargetChannel>& channels = planned.parts.front().channels;
  return channels.size() == 1 ? color_of(channels) : std::nullopt;
}

TargetPlan maps_as_inputs(const TextureSet& set, const TargetChoice& choice) {
  TargetPlan plan;
  std::vector<bool> seen(set.maps.size());
  for (std::size_t first = 0; first < set.maps.size(); ++first) {
    if (seen[first]) continue;
    PlannedFile planned{result_path(set.maps[first].path().filename(), choice), {}};
    bool holds_something = false;
    for (const std::size_t map : parts_of_file(set, first)) {
      seen[map] = true;
      TargetPart part{map, changes_of(choice), {}};
      for (std::size_t c = 0; c < set.maps[map].layout().channels.size(); ++c)
        part.channels.push_back(content_of(set, {map, c}, choice));
      const bool is_changed = std::ranges::any_of(part.channels, is_converted);
      if (!is_changed) part.changes.type = std::nullopt;  // an unchanged part keeps its pixel type
      holds_something = holds_something || is_changed;
      planned.parts.push_back(std::move(part));
    }
    if (const auto color = grey_alone(planned, choice))
      planned = {planned.path, color_map(set, *color, choice).parts};
    if (holds_something) plan.maps.push_back(std::move(planned));
  }
  for (const Parameter parameter : choice.parameters) {
    if (set.map_of(parameter) != nullptr) continue;
    if (set.parameters.count(parameter) == 0 && !is_input(parameter))
      throw usage_error("--layout as-inputs: no input contains " + std::string(parameter_name(parameter)) +
                        " (use --layout separate)");
    plan.maps.push_back(own_map(set, parameter, choice));
  }
  for (const Carried<SetParameter>& carried : set.carried) {
    if (!carried.parameter.is_map())
      throw usage_error("--" + carried.name +
                        ": --layout as-inputs cannot store a number (give a map, or use another layout)");
    const fs::path& source = set.maps[carried.parameter.channels.front().map].path();
    const auto is_written = [&](const PlannedFile& map) {
      return same_file(set.maps[map.parts.front().model].path(), source);
    };
    if (std::ranges::none_of(plan.maps, is_written))
      add_copy(source, choice.folder / source.filename(), plan);
  }
  return plan;
}

PlannedFile carried_map(const TextureSet& set, const Carried<SetParameter>& carried,
                        const TargetChoice& choice) {
  PlannedFile map =
      new_map(named(carried.name, choice.names), kGrey, {carried_channel(carried.parameter)}, set, choice);
  if (carried.parameter.is_map()) map.parts.front().model = carried.parameter.channels.front().map;
  return map;
}

// Refuses a layout that has a place for a parameter which the conversion does not make.
void require_held(const TargetChoice& choice) {
  const auto lacks = [&](Parameter held, Parameter other) {
    return choice.layout.file_with(held) != nullptr && is_wanted(choice, other);
  };
  const std::string start = "--layout " + choice.layout.name + ": cannot hold ";
  if (lacks(Parameter::kSpecular, Parameter::kMetallic))
    throw usage_error(start + "metallic (use --layout separate or --layout orm)");
  if (lacks(Parameter::kMetallic, Parameter::kDiffuse))
    throw usage_error(start + "diffuse and specular (use --layout separate or --layout specgloss)");
  for (const Parameter parameter : {Parameter::kRoughness, Parameter::kSpecular})
    if (choice.layout.file_with(parameter) != nullptr && !is_wanted(choice, parameter))
      throw usage_error("--only cannot be used with --layout " + choice.layout.name +
                        ", which would have an empty channel (remove one of the two)");
}

PlannedFile layout_map(const LayoutFile& file, const TextureSet& set, const TargetChoice& choice) {
  if (file.content.size() == 1)
    if (const auto* own = std::get_if<LayoutParameter>(&file.content.front()))
      return own_map(set, own->parameter, choice);
  std::vector<TargetChannel> channels;
  for (const LayoutContent& content : file.content)
    std::ranges::copy(channels_of(content, set, choice), std::back_inserter(channels));
  const std::vector<std::string>& names = channels.size() == 1   ? kGrey
                                          : channels.size() == 3 ? kColor
                                                                 : kColorAndAlpha;
  return new_map(named(file.name, choice.names), names, std::move(channels), set, choice);
}

// Returns the files of the layout, and a file for each parameter that has no place in them.
std::vector<PlannedFile> layout_maps(const TextureSet& set, const TargetChoice& choice) {
  require_held(choice);
  std::vector<PlannedFile> all;
  for (const LayoutFile& file : choice.layout.files)
    if (holds_something(file, set, choice)) all.push_back(layout_map(file, set, choice));
  for (const Parameter parameter : choice.parameters)
    if (choice.layout.file_with(parameter) == nullptr) all.push_back(own_map(set, parameter, choice));
  for (const Carried<SetParameter>& carried : set.carried)
    if (!choice.layout.has_place_for(carried.name)) all.push_back(carried_map(set, carried, choice));
  return all;
}

}  // namespace

std::string file_name(Parameter parameter, const TargetChoice& choice, const ResultNames& names) {
  if (const LayoutFile* file = choice.layout.file_with(parameter)) return named(file->name, names);
  const bool is_width = parameter == Parameter::kRoughness;
  return named(is_width ? choice.width_name : std::string(parameter_name(parameter)), names);
}

std::string diagnosis_name(const TargetChannel& diagnosis, const ResultNames& names) {
  const auto* measure = std::get_if<ConvertedChannel>(&diagnosis);
  return named(measure == nullptr ? "mask" : std::string(parameter_name(measure->parameter)), names);
}

namespace {

// Returns the input channel whose stored values a channel of a result repeats.
std::optional<ChannelPlace> repeated_place(const TextureSet& set, const TargetChannel& channel,
                                           const TargetChoice& choice) {
  if (const auto* place = std::get_if<ChannelPlace>(&channel)) return *place;
  const auto* made = std::get_if<ConvertedChannel>(&channel);
  if (made == nullptr || !contains(choice.unchanged, made->parameter)) return std::nullopt;
  const SetParameter* own = set.map_of(made->parameter);
  if (own == nullptr || made->index >= own->channels.size() || !own->factors.empty() ||
      choice.color_transfers.contains(made->parameter))
    return std::nullopt;
  return own->channels[made->index];
}

// Returns the file that a result would repeat. All its channels, their type and the format must be the same.
std::optional<fs::path> repeated_file(const TextureSet& set, const PlannedFile& planned,
                                      const TargetChoice& choice) {
  if (planned.parts.size() != 1) return std::nullopt;
  const std::vector<TargetChannel>& channels = planned.parts.front().channels;
  const std::optional<ChannelPlace> first = repeated_place(set, channels.front(), choice);
  if (!first) return std::nullopt;
  const ImageReader& map = set.maps[first->map];
  if (channels.size() != map.layout().channels.size() || parts_of_file(set, first->map).size() != 1 ||
      planned.path.extension() != map.path().extension())
    return std::nullopt;
  for (std::size_t c = 0; c < channels.size(); ++c)
    if (repeated_place(set, channels[c], choice) != ChannelPlace{first->map, c} ||
        (choice.type && map.layout().channels[c].type != *choice.type))
      return std::nullopt;
  return map.path();
}

}  // namespace

void require_target_scale(const TextureSet& set, const TargetPlan& plan) {
  for (const PlannedFile& map : plan.maps)
    for (const TargetPart& part : map.parts) {
      const PixelType own = set.maps[part.model].layout().channels.front().type;
      if (!is_integer(part.changes.type.value_or(own))) continue;
      for (const TargetChannel& channel : part.channels)
        if (const auto* made = std::get_if<ConvertedChannel>(&channel);
            made != nullptr && made->parameter == Parameter::kRoughness)
          throw usage_error(map.path.string() +
                            ": would contain integers, but its roughness is an exponent (use --format exr; "
                            "or --output-encoding exponent=1000 if white means an exponent of 1000, as in "
                            "MTL files; OpenGL has 128)");
    }
}

TargetPlan plan_targets(const TextureSet& set, const TargetChoice& choice) {
  if (!choice.extension.empty()) require_known_extension(choice.extension);
  TargetPlan plan;
  if (choice.layout.keeps_names) {
    plan = maps_as_inputs(set, choice);
  } else {
    plan.maps = layout_maps(set, choice);
    plan.unplaced = unplaced(set);
  }
  for (const TargetChannel& diagnosis : choice.diagnoses) {
    plan.maps.push_back(new_map(diagnosis_name(diagnosis, choice.names), kGrey, {diagnosis}, set, choice));
    fs::path& path = plan.maps.back().path;
    path = choice.diagnosis_folder / path.filename();
  }
  for (PlannedFile& map : plan.maps)
    for (TargetPart& part : map.parts)
      if (const auto color = color_of(part.channels))
        part.changes.colors = color_storage(set, *color, choice);
  std::erase_if(plan.maps, [&](const PlannedFile& map) {
    const std::optional<fs::path> file = repeated_file(set, map, choice);
    if (file) plan.copies.push_back({map.path, map.parts, *file});
    return file.has_value();
  });
  for (const CopiedFile& file : choice.copies) {
    const bool keeps_name = file.name.empty() || choice.layout.keeps_names;
    const bool turns = !file.turned_name.empty();
    const std::string name = turns        ? file.turned_name
                             : keeps_name ? file.source.filename().string()
                                          : named(file.name, choice.names) + file.source.extension().string();
    add_copy(file.source, choice.folder / name, plan, turns);
  }
  require_safe(plan, set, choice);
  return plan;
}

std::vector<TargetMap> open_targets(const TextureSet& set, const TargetPlan& plan) {
  std::vector<TargetMap> targets;
  for (const PlannedFile& map : plan.maps) {
    create_parent(map.path);
    std::vector<NewPart> parts;
    for (const TargetPart& part : map.parts) parts.push_back({&set.maps[part.model].stored(), part.changes});
    targets.push_back({image_library().create(map.path, parts), map.parts});
  }
  return targets;
}

}  // namespace remap
