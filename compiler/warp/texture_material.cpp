#include "warp/texture_material.hpp"

#include <limits>
#include <sstream>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "look/brdf.hpp"
#include "look/image.hpp"
#include "remap/convert_maps.hpp"
#include "remap/version.hpp"
#include "remap/workflow.hpp"
#include "sets/discovery.hpp"
#include "texture/texture_set.hpp"
#include "warp/warp.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

bool is_diffuse(Role role) { return role == Role::kDiffuse; }
bool is_base_color(Role role) { return role == Role::kBaseColor; }
bool is_specular(Role role) { return role == Role::kSpecular; }
bool is_metallic(Role role) { return role == Role::kMetallic; }

// Returns true if a set has a color of the diffuse lobe, and no map of the specular lobe.
bool is_albedo(const FoundSet& set) {
  const auto has = [&](bool (*wanted)(Role)) { return !uses(set, wanted).empty(); };
  return (has(is_diffuse) || has(is_base_color)) && !has(is_specular) && !has(is_metallic) &&
         !has(is_roughness);
}

FoundSet only_set(const fs::path& folder, AlbedoAlone albedo) {
  WalkOptions options;
  options.recursive = false;
  Discovery found = find_sets(folder, options);
  std::erase_if(found.sets, [&](const FoundSet& set) {
    return set.state == SetState::kSkipped && (albedo == AlbedoAlone::kRefuse || !is_albedo(set));
  });
  if (found.sets.size() != 1)
    throw input_error(folder.string() + ": contains " + std::to_string(found.sets.size()) +
                      " texture sets, but must contain exactly one (give a folder with the maps of one "
                      "material, with diffuse, specular and roughness in their names)");
  if (found.sets[0].state == SetState::kFaulty)
    throw input_error(found.sets[0].remarks.empty() ? folder.string() + ": is ambiguous"
                                                    : found.sets[0].remarks[0]);
  return found.sets[0];
}

// Adds the first map of a wanted role to the request. Returns false if the set has none.
bool add_map(const FoundSet& set, const fs::path& root, Parameter parameter, bool (*wanted)(Role),
             TextureSetRequest& request) {
  const std::vector<MapUse> found = uses(set, wanted);
  if (found.empty()) return false;
  const MapUse& use = found.front();
  request.parameters[parameter].source = MapName{root / set.maps[use.map].path, channel_names(use.channels)};
  if (parameter == Parameter::kRoughness)
    request.convention = encoding_of(use.role).value_or(RoughnessEncoding::kRoughness);
  return true;
}

// Requests the maps of the specular workflow if the set has them. Otherwise, requests the maps of the
// metallic workflow. If these are missing, too, requests the diffuse map.
TextureSetRequest request_of(const fs::path& folder, const FoundSet& set) {
  TextureSetRequest request;
  const auto add = [&](Parameter parameter, bool (*wanted)(Role)) {
    return add_map(set, folder, parameter, wanted, request);
  };
  if (is_albedo(set)) {
    if (!add(Parameter::kDiffuse, is_diffuse)) add(Parameter::kDiffuse, is_base_color);
    request.parameters[Parameter::kSpecular].source = ConstantValues{0.0f};
    request.parameters[Parameter::kRoughness].source = ConstantValues{1.0f};
    request.convention = RoughnessEncoding::kAlpha;
    return request;
  }
  if (!add(Parameter::kRoughness, is_roughness))
    throw input_error(folder.string() + ": contains no roughness map");
  if (add(Parameter::kSpecular, is_specular)) {
    if (add(Parameter::kDiffuse, is_diffuse) || add(Parameter::kDiffuse, is_base_color)) return request;
    throw input_error(folder.string() + ": contains a specular map but no diffuse map");
  }
  const bool is_metallic_set =
      add(Parameter::kMetallic, is_metallic) &&
      (add(Parameter::kBaseColor, is_base_color) || add(Parameter::kBaseColor, is_diffuse));
  if (!is_metallic_set)
    throw input_error(folder.string() +
                      ": requires diffuse and specular maps, or base color and metallic maps");
  return request;
}

SourceParameter source_of(const SetParameter& parameter, const TextureSet& set,
                          const std::vector<std::vector<std::byte>>& texels) {
  SourceParameter source;
  source.constants = parameter.constants;
  source.factors = parameter.factors;
  source.transfer = parameter.transfer;
  source.grey_tolerance = 1.0f;
  for (const ChannelPlace& place : parameter.channels) {
    const ImageLayout& layout = set.maps[place.map].layout();
    const Channel& channel = layout.channels[place.channel];
    source.name = set.maps[place.map].path().string();
    source.channel_names.push_back(channel.name);
    source.channels.push_back({texels[place.map].data() + channel.offset, channel.type,
                               static_cast<std::ptrdiff_t>(layout.texel_bytes),
                               static_cast<std::ptrdiff_t>(layout.row_bytes())});
  }
  return source;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The following functions call write(name, channels, value). It writes a map whose channels c have
// value(texel, c) for the template texel of each source texel.
void write_parameters(const auto& write, const WarpMaterial& material) {
  const auto part = [&](std::size_t first) {
    return
        [&material, first](std::uint32_t texel, std::size_t c) { return material.texels[texel][first + c]; };
  };
  write("diffuse.exr", {"R", "G", "B"}, part(0));
  write("specular.exr", {"R", "G", "B"}, part(3));
  write("alpha.exr", {"Y"}, part(6));
}

void write_profiles(const auto& write, const TabulatedMaterial& material) {
  std::vector<std::string> channels;
  for (const char* color : {"R@", "G@", "B@"})
    for (const double radius : material.radii) channels.push_back(color + number_text(radius));
  write("profiles.exr", channels, [&](std::uint32_t texel, std::size_t c) {
    return material.samples(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(material.entries[texel]));
  });
}

// Returns the list of BRDFs with paths relative to `folder`.
std::string moved_list(const fs::path& list, const fs::path& folder) {
  std::istringstream lines(read_file(list));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty()) text += fs::relative(list.parent_path() / line, folder).generic_string() + "\n";
  }
  return text;
}

}  // namespace

WarpMaterial read_texture_material(const fs::path& folder, const std::string& model, AlbedoAlone albedo) {
  WarpMaterial result;
  result.name = folder.string();
  const MapModel map_model = builtin_map_model(model);
  result.model = map_model.lobe;
  result.is_dielectric = map_model.is_dielectric;
  const FoundSet found_set = only_set(folder, albedo);
  result.is_albedo = is_albedo(found_set);
  const TextureSetRequest request = request_of(folder, found_set);
  TextureSet set = open_texture_set(request);
  WorkflowStages stages;
  stages.target = SpecularWorkflow{};
  if (request.parameters.contains(Parameter::kMetallic))
    stages.source = MetallicWorkflow{};
  else
    stages.source = SpecularWorkflow{};
  const auto converter = make_workflow_converter(stages);

  std::vector<std::vector<std::byte>> texels;
  for (ImageReader& map : set.maps) texels.push_back(texels_of(map));
  const ImageLayout& layout = set.maps[set.first_map()].layout();
  result.width = static_cast<std::size_t>(layout.width);
  result.height = static_cast<std::size_t>(layout.height);
  result.texels.resize(result.width * result.height);
  float* first = result.texels.data()->data();
  MapConversion conversion;
  conversion.width = result.width;
  conversion.height = result.height;
  conversion.source_convention = set.convention;
  conversion.target_convention = RoughnessEncoding::kAlpha;
  for (const auto& [parameter, found] : set.parameters)
    conversion.sources[parameter] = source_of(found, set, texels);
  const auto want = [&](Parameter parameter, std::size_t from, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c)
      conversion.targets[parameter].channels.push_back(
          float_channel(first + from + c, result.width, kWarpParameters));
  };
  want(Parameter::kDiffuse, 0, 3);
  want(Parameter::kSpecular, 3, 3);
  want(Parameter::kRoughness, 6, 1);
  convert_maps(*converter, conversion);
  return result;
}

std::vector<fs::path> write_copied_set(const fs::path& folder, const std::vector<std::uint32_t>& texels,
                                       const MaterialRef& source, const MaterialRef& goal) {
  std::vector<fs::path> files;
  const auto write = [&](const char* name, const std::vector<std::string>& channels, const auto& value) {
    Image image{static_cast<int>(source.width()),
                static_cast<int>(source.height()),
                static_cast<int>(channels.size()),
                {}};
    image.values.reserve(texels.size() * channels.size());
    for (const std::uint32_t texel : texels)
      for (std::size_t c = 0; c < channels.size(); ++c)
        image.values.push_back(texel == kNoTexel ? kNan : value(texel, c));
    files.push_back(folder / name);
    write_exr(files.back(), image, {{"Software", std::string("remapc ") + kVersion}}, channels);
  };
  const TabulatedMaterial* table = goal.tabulated();
  if (table == nullptr) {
    write_parameters(write, *goal.parametric());
  } else if (table->table.extension() == ".exr") {
    write_profiles(write, *table);
  } else {
    write("index.exr", {"Y"},
          [&](std::uint32_t texel, std::size_t) { return static_cast<float>(table->entries[texel]); });
    const bool is_csv = table->table.extension() == ".csv";
    files.push_back(folder / (is_csv ? "profiles.csv" : "brdfs.txt"));
    write_file(files.back(), is_csv ? read_file(table->table) : moved_list(table->table, folder));
  }
  write("template_texel.exr", {"X", "Y"}, [&](std::uint32_t texel, std::size_t c) {
    return static_cast<float>(c == 0 ? texel % goal.width() : texel / goal.width());
  });
  return files;
}

}  // namespace remap
