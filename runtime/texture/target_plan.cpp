#include "texture/target_plan.hpp"

#include <algorithm>
#include <array>
#include <system_error>

#include "error.hpp"
#include "files.hpp"
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

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  const fs::path canonical_a = fs::weakly_canonical(a, ignored),
                 canonical_b = fs::weakly_canonical(b, ignored);
  return !canonical_a.empty() && canonical_a == canonical_b;
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

void require_safe(const std::vector<PlannedMap>& planned, const TextureSet& set, const TargetChoice& choice) {
  std::error_code ignored;
  if (fs::exists(choice.folder, ignored) && !fs::is_directory(choice.folder, ignored))
    throw Error(ErrorKind::kOutput, choice.folder.string() + ": is a file; expected a folder");
  for (std::size_t i = 0; i < planned.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (planned[i].path == planned[k].path)
        throw Error(
            ErrorKind::kUsage,
            planned[i].path.string() + ": would be the name of two results; expected inputs with two names");
    for (const ImageReader& map : set.maps) require_safe(planned[i].path, map.path());
    require_free(planned[i].path, choice.force);
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

bool is_converted(const TargetChannel& channel) { return channel.content != Content::kCopy; }

ImageChanges changes_of(const TargetChoice& choice) {
  ImageChanges changes;
  changes.type = choice.type;
  changes.metadata = choice.metadata;
  return changes;
}

std::string own_name(const std::string& name, const TextureSet& set, const TargetChoice& choice) {
  const std::string extension =
      choice.extension.empty() ? set.maps.front().path().extension().string() : "." + choice.extension;
  return choice.names.before + name + choice.names.after + extension;
}

// A map of its own, for what is a constant in the set or is not in it at all.
PlannedMap new_map(const std::string& name, Content content, std::size_t channel_count, const TextureSet& set,
                   const TargetChoice& choice) {
  PlannedMap planned{choice.folder / own_name(name, set, choice), 0, changes_of(choice), {}};
  planned.changes.channels =
      channel_count == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  planned.changes.is_linear = true;
  for (std::size_t c = 0; c < channel_count; ++c) planned.channels.push_back({content, c, {}});
  return planned;
}

}  // namespace

std::vector<PlannedMap> plan_targets(const TextureSet& set, const TargetChoice& choice) {
  if (!choice.extension.empty()) require_known_extension(choice.extension);
  std::vector<PlannedMap> all;
  for (std::size_t map = 0; map < set.maps.size(); ++map) {
    PlannedMap planned{result_path(set.maps[map].path().filename(), choice), map, changes_of(choice), {}};
    for (std::size_t c = 0; c < set.maps[map].layout().channels.size(); ++c)
      planned.channels.push_back(content_of(set, {map, c}, choice));
    if (std::any_of(planned.channels.begin(), planned.channels.end(), is_converted)) all.push_back(planned);
  }
  if (!set.roughness.is_map() && choice.roughness)
    all.push_back(new_map("roughness", Content::kRoughness, 1, set, choice));
  if (!set.specular.is_map() && choice.specular)
    all.push_back(new_map("specular", Content::kSpecular, set.specular.channel_count(), set, choice));
  if (choice.mask) {
    PlannedMap mask = new_map("mask", Content::kMask, 1, set, choice);
    const fs::path name = *choice.mask;
    mask.path = choice.folder /
                (choice.names.before + name.stem().string() + choice.names.after + name.extension().string());
    mask.changes.type = std::nullopt;
    all.push_back(mask);
  }
  require_safe(all, set, choice);
  return all;
}

std::vector<TargetMap> open_targets(const TextureSet& set, const std::vector<PlannedMap>& planned,
                                    const TargetChoice& choice) {
  create_parent(choice.folder / "any file");
  std::vector<TargetMap> targets;
  for (const PlannedMap& map : planned) {
    targets.push_back({ImageWriter(map.path, set.maps[map.model], map.changes), map.channels});
    TargetMap& target = targets.back();
    const auto specular =
        std::find_if(target.channels.begin(), target.channels.end(),
                     [](const TargetChannel& c) { return c.content == Content::kSpecular; });
    if (specular == target.channels.end()) continue;
    const auto channel = static_cast<std::size_t>(specular - target.channels.begin());
    target.specular_transfer = stored_transfer(set, target.writer.layout().channels[channel].type);
  }
  return targets;
}

}  // namespace remap
