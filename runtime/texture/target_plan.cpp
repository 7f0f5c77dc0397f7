#include "texture/target_plan.hpp"

#include <algorithm>
#include <array>
#include <system_error>

#include "error.hpp"
#include "files.hpp"
#include "named_values.hpp"
#include "nearest_name.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

using Content = TargetChannel::Content;

void require_known_extension(const std::string& extension) {
  static const std::array<std::string, 9> kExtensions = {"exr",  "tif", "tiff", "png", "jpg",
                                                         "jpeg", "tga", "bmp",  "hdr"};
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end())
    throw Error(ErrorKind::kUsage, "--format: is " + extension + suggestion(extension, kExtensions));
}

fs::path result_path(fs::path name, const TargetChoice& choice) {
  if (!choice.extension.empty()) name.replace_extension(choice.extension);
  return choice.folder / name;
}

void require_safe(const fs::path& output, const fs::path& input) {
  if (same_file(output, input))
    throw Error(ErrorKind::kUsage,
                output.string() + ": is the input " + input.string() + "; expected another folder");
}

void require_free(const fs::path& output, bool force) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(output, ignored);
  if (!fs::exists(status)) return;
  if (fs::is_directory(output, ignored))
    throw Error(ErrorKind::kOutput, output.string() + ": is a folder; expected a name that is free");
  if (!force)
    throw Error(ErrorKind::kOutput, output.string() + ": exists; expected a name that is free, or --force");
}

void require_safe(const TargetPlan& plan, const TextureSet& set, const TargetChoice& choice) {
  std::error_code ignored;
  if (fs::exists(choice.folder, ignored) && !fs::is_directory(choice.folder, ignored))
    throw Error(ErrorKind::kOutput, choice.folder.string() + ": is a file; expected a folder");
  std::vector<fs::path> results;
  for (const PlannedMap& map : plan.maps) results.push_back(map.path);
  for (const PlannedCopy& copy : plan.copies) results.push_back(copy.path);
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (results[i] == results[k])
        throw Error(
            ErrorKind::kUsage,
            results[i].string() + ": would be the name of two results; expected inputs with two names");
    for (const ImageReader& map : set.maps) require_safe(results[i], map.path());
    for (const PlannedCopy& copy : plan.copies) require_safe(results[i], copy.source);
    require_free(results[i], choice.force);
  }
}

// What becomes of a channel of a map.
TargetChannel content_of(const TextureSet& set, const ChannelPlace& place, const TargetChoice& choice) {
  const auto &roughness = set.roughness.channels, &specular = set.specular.channels;
  const bool is_roughness = std::find(roughness.begin(), roughness.end(), place) != roughness.end();
  const auto found = std::find(specular.begin(), specular.end(), place);
  const bool is_specular = found != specular.end();
  if (is_roughness && is_specular) {
    const ImageReader& reader = set.maps[place.map];
    throw Error(ErrorKind::kUsage,
                reader.path().string() + ": channel " + reader.layout().channels[place.channel].name +
                    " is both roughness and specular; expected FILE:CHANNEL to tell them apart");
  }
  if (is_roughness && choice.roughness) return {Content::kRoughness, 0, {}};
  if (is_specular && choice.specular)
    return {Content::kSpecular, static_cast<std::size_t>(found - specular.begin()), {}};
  return {Content::kCopy, 0, place};
}

ImageChanges changes_of(const TargetChoice& choice) {
  ImageChanges changes;
  changes.type = choice.type;
  changes.metadata = choice.metadata;
  return changes;
}

const std::vector<std::string> kGrey = {"Y"}, kColour = {"R", "G", "B"},
                               kColourAndAlpha = {"R", "G", "B", "A"};

std::string own_name(const std::string& name, bool is_grey, const TextureSet& set,
                     const TargetChoice& choice) {
  std::string extension = choice.extension.empty() ? set.maps[set.first_map()].path().extension().string()
                                                   : "." + choice.extension;
  if (is_grey && extension == ".hdr") extension = ".exr";  // it has three channels or none
  return choice.names.before + name + choice.names.after + extension;
}

std::vector<TargetChannel>::const_iterator find_specular(const std::vector<TargetChannel>& channels) {
  return std::find_if(channels.begin(), channels.end(),
                      [](const TargetChannel& channel) { return channel.content == Content::kSpecular; });
}

// How the values of specular are stored in a file of this pixel type: as in the source, where both hold whole
// numbers.
Transfer stored_transfer(const TextureSet& set, PixelType type) {
  return set.specular.is_map() && is_integer(type) ? set.specular.transfer : Transfer::kLinear;
}

// A map of its own, for what is a constant in the set or has another file there.
PlannedMap new_map(const std::string& name, const std::vector<std::string>& channel_names,
                   std::vector<TargetChannel> channels, const TextureSet& set, const TargetChoice& choice) {
  const bool has_specular = find_specular(channels) != channels.end();
  PlannedPart part{set.first_map(), changes_of(choice), std::move(channels)};
  part.changes.channels = channel_names;
  part.changes.transfer = has_specular ? set.specular.transfer : Transfer::kLinear;
  return {choice.folder / own_name(name, channel_names.size() == 1, set, choice), {part}};
}

PlannedMap roughness_map(const TextureSet& set, const TargetChoice& choice) {
  return new_map("roughness", kGrey, {{Content::kRoughness, 0, {}}}, set, choice);
}

std::vector<TargetChannel> specular_channels(const TextureSet& set) {
  std::vector<TargetChannel> channels;
  for (std::size_t c = 0; c < set.specular.channel_count(); ++c)
    channels.push_back({Content::kSpecular, c, {}});
  return channels;
}

PlannedMap specular_map(const TextureSet& set, const TargetChoice& choice) {
  const std::vector<TargetChannel> channels = specular_channels(set);
  PlannedMap planned = new_map("specular", channels.size() == 1 ? kGrey : kColour, channels, set, choice);
  if (set.specular.is_map()) planned.parts.front().model = set.specular.channels.front().map;
  return planned;
}

TargetChannel carried_channel(const SetParameter& parameter) {
  if (parameter.is_map()) return {Content::kCopy, 0, parameter.channels.front()};
  return {Content::kConstant, 0, {}, parameter.constants.front()};
}

TargetChannel carried_channel(const TextureSet& set, const std::string& name, float otherwise) {
  for (const CarriedParameter& carried : set.carried)
    if (carried.name == name) return carried_channel(carried.parameter);
  return {Content::kConstant, 0, {}, otherwise};
}

bool has_name(const TextureSet& set, const ChannelPlace& place) {
  const auto holds = [&](const SetParameter& parameter) {
    return std::find(parameter.channels.begin(), parameter.channels.end(), place) != parameter.channels.end();
  };
  return holds(set.roughness) || holds(set.specular) ||
         std::any_of(set.carried.begin(), set.carried.end(),
                     [&](const CarriedParameter& carried) { return holds(carried.parameter); });
}

// New layouts hold what has a name; nothing of an input is dropped unsaid.
void require_nothing_lost(const TextureSet& set) {
  for (std::size_t map = 0; map < set.maps.size(); ++map) {
    const ImageLayout& layout = set.maps[map].layout();
    for (std::size_t c = 0; c < layout.channels.size(); ++c) {
      if (has_name(set, {map, c})) continue;
      throw Error(ErrorKind::kUsage, set.maps[map].path().string() + ": channel " + layout.channels[c].name +
                                         " would be lost; expected --occlusion or --metallic FILE:CHANNEL to "
                                         "name it, or --layout as-inputs");
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

// Adds a copy where the file is neither written nor copied under that name already.
void add_copy(const fs::path& source, const fs::path& path, TargetPlan& plan) {
  const auto is_there = [&](const auto& result) { return result.path == path; };
  if (std::any_of(plan.maps.begin(), plan.maps.end(), is_there) ||
      std::any_of(plan.copies.begin(), plan.copies.end(), is_there))
    return;
  std::error_code ignored;
  if (!fs::is_regular_file(source, ignored))
    throw Error(ErrorKind::kInput, source.string() + ": is no file that can be read; expected one to copy");
  plan.copies.push_back({source, path});
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
      PlannedPart part{map, changes_of(choice), {}};
      for (std::size_t c = 0; c < set.maps[map].layout().channels.size(); ++c)
        part.channels.push_back(content_of(set, {map, c}, choice));
      const bool is_changed = std::any_of(part.channels.begin(), part.channels.end(), is_converted);
      if (!is_changed) part.changes.type = std::nullopt;  // what is not converted stays as it is
      holds_something = holds_something || is_changed;
      planned.parts.push_back(std::move(part));
    }
    if (holds_something) plan.maps.push_back(std::move(planned));
  }
  if (!set.roughness.is_map() && choice.roughness) plan.maps.push_back(roughness_map(set, choice));
  if (!set.specular.is_map() && choice.specular) plan.maps.push_back(specular_map(set, choice));
  for (const CarriedParameter& carried : set.carried) {
    if (!carried.parameter.is_map())
      throw Error(ErrorKind::kUsage, "--" + carried.name +
                                         ": is a number, which --layout as-inputs has no place for; "
                                         "expected a map, or another layout");
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
  if (choice.roughness) all.push_back(roughness_map(set, choice));
  if (choice.specular) all.push_back(specular_map(set, choice));
  for (const CarriedParameter& carried : set.carried) all.push_back(carried_map(set, carried, choice));
  return all;
}

std::vector<PlannedMap> packed_maps(const TextureSet& set, const TargetChoice& choice) {
  if (!choice.roughness || (choice.layout == Layout::kSpecGloss && !choice.specular))
    throw Error(ErrorKind::kUsage, "--only: leaves a channel of --layout " +
                                       std::string(layout_name(choice.layout)) + " empty; expected both");
  if (choice.layout == Layout::kSpecGloss) {
    std::vector<TargetChannel> channels = specular_channels(set);
    channels.resize(3, channels.front());  // grey in every colour
    channels.push_back({Content::kRoughness, 0, {}});
    std::vector<PlannedMap> all = {new_map("specular_glossiness", kColourAndAlpha, channels, set, choice)};
    for (const CarriedParameter& carried : set.carried) all.push_back(carried_map(set, carried, choice));
    return all;
  }
  std::vector<PlannedMap> all = {new_map(std::string(layout_name(choice.layout)), kColour,
                                         {carried_channel(set, "occlusion", 1.0f),
                                          {Content::kRoughness, 0, {}},
                                          carried_channel(set, "metallic", 0.0f)},
                                         set, choice)};
  if (choice.specular) all.push_back(specular_map(set, choice));
  return all;
}

constexpr NamedValues<Layout, 5> kLayouts = {{{Layout::kAsInputs, "as-inputs"},
                                              {Layout::kSeparate, "separate"},
                                              {Layout::kOrm, "orm"},
                                              {Layout::kArm, "arm"},
                                              {Layout::kSpecGloss, "specgloss"}}};

}  // namespace

std::string_view layout_name(Layout layout) { return name_of(kLayouts, layout); }

std::optional<Layout> layout_from_name(std::string_view name) { return value_named(kLayouts, name); }

std::vector<std::string> layout_names() { return names_of(kLayouts); }

TargetPlan plan_targets(const TextureSet& set, const TargetChoice& choice) {
  if (!choice.extension.empty()) require_known_extension(choice.extension);
  TargetPlan plan;
  if (choice.layout == Layout::kAsInputs) {
    plan = maps_as_inputs(set, choice);
  } else {
    require_nothing_lost(set);
    plan.maps = choice.layout == Layout::kSeparate ? separate_maps(set, choice) : packed_maps(set, choice);
  }
  if (choice.mask) {
    PlannedMap mask = new_map("mask", kGrey, {{Content::kMask, 0, {}}}, set, choice);
    const fs::path name = *choice.mask;
    mask.path = choice.folder /
                (choice.names.before + name.stem().string() + choice.names.after + name.extension().string());
    mask.parts.front().changes.type = std::nullopt;
    plan.maps.push_back(mask);
  }
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

std::vector<TargetMap> open_targets(const TextureSet& set, const TargetPlan& plan,
                                    const TargetChoice& choice) {
  create_parent(choice.folder / "any file");
  std::vector<TargetMap> targets;
  for (const PlannedMap& map : plan.maps) {
    std::vector<ImagePart> parts;
    for (const PlannedPart& part : map.parts) parts.push_back({&set.maps[part.model], part.changes});
    targets.push_back({ImageWriter(map.path, parts), {}});
    TargetMap& target = targets.back();
    for (std::size_t p = 0; p < map.parts.size(); ++p) {
      const std::vector<TargetChannel>& channels = map.parts[p].channels;
      target.parts.push_back({channels});
      const auto specular = find_specular(channels);
      if (specular == channels.end()) continue;
      const auto channel = static_cast<std::size_t>(specular - channels.begin());
      target.parts[p].specular_transfer =
          stored_transfer(set, target.writer.layout(static_cast<int>(p)).channels[channel].type);
    }
  }
  return targets;
}

}  // namespace remap
