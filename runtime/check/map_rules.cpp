// This file holds the rules for single maps: their tags, channels and texels.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "assets/maps/map_pixels.hpp"
#include "check/rules.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "texture/normal_green.hpp"

namespace remap::look {
namespace {

using Plane = std::vector<float>;

std::string channel_text(const MaterialUse& use) {
  return use.channels == Channels::kWhole ? "" : std::string(name_of(kChannels, use.channels));
}

// A Shares holds the fractions of values close to 0, close to 1 and between.
struct Shares {
  double low = 0.0, high = 0.0, between = 0.0;
};
Shares shares_of(const Plane& plane) {
  constexpr float kNear = 0.06f;
  Shares shares;
  for (const float value : plane)
    (value < kNear ? shares.low : value > 1.0f - kNear ? shares.high : shares.between) += 1.0;
  const double count = static_cast<double>(std::max<std::size_t>(1, plane.size()));
  return {shares.low / count, shares.high / count, shares.between / count};
}

bool is_constant(const Plane& plane) {
  const auto [least, most] = std::ranges::minmax(plane);
  return least == most;
}

bool all_are_constant(const std::vector<const Plane*>& planes) {
  return std::ranges::all_of(planes, [](const Plane* plane) { return is_constant(*plane); });
}

NormalShares normals_of(const std::vector<const Plane*>& rgb) {
  return normal_shares({*rgb[0], *rgb[1], *rgb[2]});
}

enum class Orientation { kUnknown, kOpenGl, kDirectX };

// Returns the orientation in which the slopes of normals belong to a surface. On a surface, the slope along x
// changes along y as the slope along y changes along x.
Orientation seen_orientation(const std::vector<const Plane*>& rgb, int columns, int rows) {
  const auto slopes = [&](std::size_t i) {
    const double x = 2.0 * (*rgb[0])[i] - 1.0, y = 2.0 * (*rgb[1])[i] - 1.0;
    const double z = std::max(0.1, 2.0 * static_cast<double>((*rgb[2])[i]) - 1.0);
    return std::array{-x / z, y / z};  // slopes along columns and, for green up, down the rows
  };
  double up = 0.0, down = 0.0;  // differences from the slopes of a surface, with green up and with green down
  for (int y = 1; y + 1 < rows; ++y)
    for (int x = 1; x + 1 < columns; ++x) {
      const auto at = [&](int dx, int dy) {
        return slopes(static_cast<std::size_t>(y + dy) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(x + dx));
      };
      const double across = at(0, 1)[0] - at(0, -1)[0], along = at(1, 0)[1] - at(-1, 0)[1];
      up += (across - along) * (across - along);
      down += (across + along) * (across + along);
    }
  // least ratio of the differences; noise and rounding add the same amount to both
  constexpr double kClear = 2.0;
  return down > kClear * up   ? Orientation::kOpenGl
         : up > kClear * down ? Orientation::kDirectX
                              : Orientation::kUnknown;
}

Orientation claimed(const CheckedMaterial& material, const MaterialMap& map, const GltfConsumer* reader) {
  if (material.kind == MaterialKind::kGltf) return Orientation::kOpenGl;
  if (const auto stated = stated_green(map.name))
    return *stated == NormalGreen::kUp ? Orientation::kOpenGl : Orientation::kDirectX;
  if (reader != nullptr) return reader->wants_directx_normals ? Orientation::kDirectX : Orientation::kOpenGl;
  return Orientation::kUnknown;
}

// Returns the fraction of texels between 0.15 and 0.85 whose neighbours, two texels away, are all in this
// range, too. This excludes edges, because they are thinner.
double share_of_grey_areas(const Plane& plane, int columns, int rows) {
  constexpr int kReach = 2;
  const auto is_grey = [&](int x, int y) {
    const float value =
        plane[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)];
    return value > 0.15f && value < 0.85f;
  };
  std::size_t inside = 0;
  for (int y = kReach; y + kReach < rows; ++y)
    for (int x = kReach; x + kReach < columns; ++x)
      inside += is_grey(x, y) && is_grey(x - kReach, y) && is_grey(x + kReach, y) && is_grey(x, y - kReach) &&
                is_grey(x, y + kReach);
  return plane.empty() ? 0.0 : static_cast<double>(inside) / static_cast<double>(plane.size());
}

// Returns three channels for a color, otherwise the channel of the use.
std::vector<const Plane*> planes_of(const CheckedMaterial& material, const MaterialUse& use) {
  const bool is_color =
      use.role == Role::kBaseColor || use.role == Role::kDiffuse || use.role == Role::kNormal;
  std::vector<const Plane*> planes = is_color ? material.colors(use) : std::vector<const Plane*>{};
  if (const Plane* plane = material.plane(use); planes.empty() && plane != nullptr) planes = {plane};
  return planes;
}

// Returns the first value of each channel, for constant channels.
std::vector<float> values_of(const std::vector<const Plane*>& planes) {
  std::vector<float> values;
  for (const Plane* plane : planes) values.push_back(plane->front());
  return values;
}

std::string list_text(const std::vector<float>& values) {
  return joined(values, ",", [](double value) { return number_text(rounded(value, 3)); });
}

// Returns true for the tiles of one map, which share role and channels.
bool is_tile_of(const CheckedMaterial& material, const MaterialUse& use, const MaterialUse& other) {
  return material.maps[other.map].tile != 0 && use.role == other.role && use.channels == other.channels;
}

bool is_first_tile(const CheckedMaterial& material, const MaterialUse& use) {
  const auto first = std::ranges::find_if(
      material.uses, [&](const MaterialUse& other) { return is_tile_of(material, use, other); });
  return &*first == &use;
}

// Returns true if all tiles of the map have this tile's value in every texel. Only then can one number
// replace them.
bool tiles_are_equal(const CheckedMaterial& material, const MaterialUse& use) {
  const std::vector<float> own = values_of(planes_of(material, use));
  return std::ranges::all_of(material.uses, [&](const MaterialUse& other) {
    if (!is_tile_of(material, use, other)) return true;
    const std::vector<const Plane*> planes = planes_of(material, other);
    return all_are_constant(planes) && values_of(planes) == own;
  });
}

// Returns the fix that replaces a map of one value by a factor. Factors and options are linear numbers.
Fix number_fix(const CheckedMaterial& material, const MaterialUse& use, std::vector<float> values) {
  if (use.role == Role::kNormal) return "remove the map: it changes nothing";
  const ImageLayout& layout = material.texels(use)->layout;
  if (is_color_role(use.role) && is_integer(layout.channels.front().type) &&
      layout.tagged_transfer.value_or(Transfer::kSrgb) == Transfer::kSrgb)
    to_linear(Transfer::kSrgb, values);
  for (std::size_t c = 0; c < std::min(values.size(), use.factors.size()); ++c)
    values[c] *= static_cast<float>(use.factors[c]);
  const std::string number = list_text(values);
  if (material.kind == MaterialKind::kGltf)
    return "set " + use.factor_name + " to " + number + " in " + material.path.filename().string() +
           ", and remove the map";
  return "remove the map, and use the number " + number + (values.size() > 1 ? " (linear)" : "") +
         " instead of the map";
}

// Returns true if a role of the material uses the channel.
bool is_used(const CheckedMaterial& material, std::size_t map, std::size_t channel) {
  return std::ranges::any_of(material.uses, [&](const MaterialUse& use) {
    return use.map == map && material.plane(use) == &material.texels(use)->channels[channel];
  });
}

// Returns the channels of a map with two of them exchanged: `R=R,G=B,B=G`.
std::string swapped(const TexelSample& texels, std::size_t a, std::size_t b) {
  std::string text;
  for (std::size_t c = 0; c < texels.channels.size(); ++c) {
    const std::size_t source = c == a ? b : c == b ? a : c;
    text += (c > 0 ? "," : "") + texels.layout.channels[c].name + "=" + texels.layout.channels[source].name;
  }
  return text;
}

// Calls `judge(use)` for each use in this material whose image can be read. Several uses of one map and
// channel are judged once.
template <typename Judge>
void for_uses(const CheckedMaterial& material, Judge judge) {
  std::set<std::pair<std::filesystem::path, Channels>> seen;
  for (const MaterialUse& use : material.uses)
    if (!use.is_neighbour && material.texels(use) != nullptr &&
        seen.insert({material.maps[use.map].file, use.channels}).second)
      judge(use);
}

}  // namespace

void linear_color(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                  std::vector<MaterialFinding>& findings) {
  for_uses(material, [&](const MaterialUse& use) {
    const MaterialMap& map = material.maps[use.map];
    const ImageLayout& layout = material.texels(use)->layout;
    if (!is_color_role(use.role) || use.channels == Channels::kAlpha ||
        !is_integer(layout.channels.front().type) || layout.tagged_transfer != Transfer::kLinear)
      return;
    findings.push_back(
        {rule.name, Confidence::kLikely, map.shown, "",
         "is a color stored as integers, and its file has the tag linear; programs that ignore the tag (as "
         "glTF requires) decode it as sRGB",
         image_fix(
             material, map,
             "export it again as sRGB if its values are linear; if they are sRGB, as in most files, tag it "
             "as sRGB",
             "--attrib oiio:ColorSpace sRGB --eraseattrib oiio:Gamma --eraseattrib remap:color_space")});
  });
}

void specgloss_channels(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                        std::vector<MaterialFinding>& findings) {
  for_uses(material, [&](const MaterialUse& use) {
    const TexelSample& texels = *material.texels(use);
    if (use.channels != Channels::kAlpha || use.role == Role::kOther || use.role == Role::kOpacity ||
        texels.layout.alpha_channel >= 0)
      return;
    const MaterialMap& map = material.maps[use.map];
    const std::size_t count = texels.layout.channels.size();
    findings.push_back(
        {rule.name, Confidence::kCertain, map.shown, "A",
         "has " + std::to_string(count) + (count == 1 ? " channel" : " channels") + " and no alpha, so " +
             std::string(role_name(use.role)) + " is read as 1 everywhere",
         "export it again with four channels, " + std::string(role_name(use.role)) + " in alpha"});
  });
}

void specular_color(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                    std::vector<MaterialFinding>& findings) {
  // Ks of MTL is not a reflectance at normal incidence. In a set with a metallic map, a specular map is a
  // specular level.
  const bool has_metallic =
      std::ranges::any_of(material.uses, [](const MaterialUse& use) { return use.role == Role::kMetallic; });
  if (material.kind == MaterialKind::kMtl || has_metallic) return;
  for_uses(material, [&](const MaterialUse& use) {
    if (use.role != Role::kSpecular) return;
    const MaterialMap& map = material.maps[use.map];
    const ImageLayout& layout = material.texels(use)->layout;
    const Transfer usual = is_integer(layout.channels.front().type) ? Transfer::kSrgb : Transfer::kLinear;
    const Transfer transfer = layout.tagged_transfer.value_or(usual);
    std::vector<Plane> linear;
    for (const Plane* plane : material.colors(use)) {
      linear.push_back(*plane);
      to_linear(transfer, linear.back());
      if (const std::size_t c = linear.size() - 1; c < use.factors.size())
        for (float& value : linear.back()) value *= static_cast<float>(use.factors[c]);
    }
    const auto issue = color_issue(use.role, transfer, linear);
    if (!issue) return;
    Fix fix = "check its source: the export may have lost the map";
    if (issue->transfer) {
      const std::string name(name_of(kTransfers, *issue->transfer));
      fix = material.kind == MaterialKind::kGltf ? "export it again: glTF reads colors as sRGB"
                                                 : "convert it with --color-space specular=" + name;
    }
    findings.push_back({rule.name, issue->transfer ? Confidence::kLikely : Confidence::kPossible, map.shown,
                        "", "specular, " + issue->text, fix});
  });
}

void constant_map(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                  std::vector<MaterialFinding>& findings) {
  for_uses(material, [&](const MaterialUse& use) {
    // Other roles are skipped, because metallic, occlusion, opacity and specular often have one value.
    const bool is_color =
        use.role == Role::kBaseColor || use.role == Role::kDiffuse || use.role == Role::kNormal;
    if (!is_color && !is_roughness(use.role)) return;
    const std::vector<const Plane*> planes = planes_of(material, use);
    const int alpha = material.texels(use)->layout.alpha_channel;
    if (is_color && alpha >= 0 &&
        !is_constant(material.texels(use)->channels[static_cast<std::size_t>(alpha)]))
      return;  // alpha cuts out a shape of one color
    // People use images of up to this side instead of a number, so a constant image is intended.
    constexpr int kSmall = 4;
    const ImageLayout& layout = material.texels(use)->layout;
    if (planes.empty() || std::min(layout.width, layout.height) <= kSmall || !all_are_constant(planes))
      return;
    // If other channels of the map are in use, the map is needed.
    if (!std::ranges::all_of(material.uses, [&](const MaterialUse& other) {
          return other.map != use.map || all_are_constant(planes_of(material, other));
        }))
      return;
    const MaterialMap& map = material.maps[use.map];
    if (map.tile != 0 && (!is_first_tile(material, use) || !tiles_are_equal(material, use))) return;
    const std::string value = list_text(values_of(planes));
    findings.push_back({rule.name, map.tile != 0 ? Confidence::kPossible : Confidence::kCertain, map.shown,
                        channel_text(use),
                        std::string(role_name(use.role)) + " is " + value + " in every texel" +
                            (map.tile != 0 ? " of every tile" : ""),
                        number_fix(material, use, values_of(planes))});
  });
}

// Finds banding. At roughness r, an 8-bit step changes alpha = r^2 by a fraction of 2 / (255 r). At r = 10 /
// 255, this is 20 %.
void banding(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
             std::vector<MaterialFinding>& findings) {
  for_uses(material, [&](const MaterialUse& use) {
    const Plane* plane = material.plane(use);
    if (!is_roughness(use.role) || plane == nullptr) return;
    const ImageLayout& layout = material.texels(use)->layout;
    if (layout.channels.front().type != PixelType::kUint8) return;
    const bool is_gloss = use.role == Role::kGlossiness || use.role == Role::kGlossinessSquared;
    const int last = use.role == Role::kAlphaWidth ? 5 : 10;
    std::set<int> levels;
    std::size_t low = 0;
    for (const float value : *plane) {
      const int level = static_cast<int>(std::lround(255.0f * (is_gloss ? 1.0f - value : value)));
      if (level > last) continue;
      ++low;
      levels.insert(level);
    }
    const double share =
        static_cast<double>(low) / static_cast<double>(std::max<std::size_t>(1, plane->size()));
    constexpr double kShare = 0.2;
    constexpr std::size_t kLevels = 3;
    if (share < kShare || levels.size() < kLevels) return;
    findings.push_back(
        {rule.name, Confidence::kLikely, material.maps[use.map].shown, channel_text(use),
         percent(share) + " of its texels have only " + std::to_string(levels.size()) + " values up to " +
             std::to_string(last) + " / 255; each step widens highlights by 20 % or more",
         "export it again with 16 bits or as half float; no conversion can restore the missing bits"});
  });
}

void bad_values(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                std::vector<MaterialFinding>& findings) {
  std::set<std::size_t> seen;
  for_uses(material, [&](const MaterialUse& use) {
    const TexelSample& texels = *material.texels(use);
    if (!texels.has_floats() || !seen.insert(use.map).second) return;
    const bool has_range = use.role != Role::kHeight && use.role != Role::kEmissive &&
                           use.role != Role::kOther && use.role != Role::kIor && use.role != Role::kNormal &&
                           use.role != Role::kSubsurface;
    std::string what;
    const auto add = [&](std::size_t count, const std::string& text) {
      if (count > 0) what += (what.empty() ? "" : ", ") + std::to_string(count) + " " + text;
    };
    add(texels.nan_count, "NaN or infinite");
    if (has_range) add(texels.negative_count, "negative");
    if (has_range) add(texels.above_one_count, "above 1");
    if (what.empty()) return;
    findings.push_back({rule.name, Confidence::kCertain, material.maps[use.map].shown, "",
                        "has values that are not " + std::string(role_name(use.role)) + ": " + what,
                        image_fix(material, material.maps[use.map],
                                  has_range ? "move these values into the range from 0 to 1"
                                            : "fill such texels from their neighbours",
                                  has_range ? "--fixnan box3 --clamp:min=0:max=1" : "--fixnan box3")});
  });
}

void metallic_greys(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                    std::vector<MaterialFinding>& findings) {
  for_uses(material, [&](const MaterialUse& use) {
    const Plane* plane = use.role == Role::kMetallic ? material.plane(use) : nullptr;
    if (plane == nullptr) return;
    const TexelSample& texels = *material.texels(use);
    const double share = share_of_grey_areas(*plane, texels.columns, texels.rows);
    constexpr double kShare = 0.05;
    if (share < kShare) return;
    findings.push_back(
        {rule.name, Confidence::kPossible, material.maps[use.map].shown, channel_text(use),
         "metallic is between 0.15 and 0.85 over areas of " + percent(share) +
             " of the map; materials are metal or not, and greys belong to edges",
         "if this map was made from a specular map, convert the original specular maps again"});
  });
}

void channel_order(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                   std::vector<MaterialFinding>& findings) {
  for_uses(material, [&](const MaterialUse& use) {
    const Plane* plane =
        use.role == Role::kMetallic && use.channels != Channels::kWhole ? material.plane(use) : nullptr;
    const TexelSample& texels = *material.texels(use);
    if (plane == nullptr || texels.channels.size() < 3) return;
    const bool varies = shares_of(*plane).between > 0.5;
    if (!varies && !is_constant(*plane)) return;
    for (std::size_t c = 0; c < texels.channels.size(); ++c) {
      const Plane& other = texels.channels[c];
      const Shares shares = shares_of(other);
      if (&other == plane || shares.between > 0.15 || shares.low < 0.01 || shares.high < 0.01) continue;
      if (!varies && is_used(material, use.map, c)) continue;
      const std::string& name = texels.layout.channels[c].name;
      const MaterialMap& map = material.maps[use.map];
      findings.push_back({rule.name, Confidence::kLikely, map.shown, channel_text(use),
                          "metallic is read from " + channel_text(use) +
                              (varies ? ", which varies like roughness; " : ", which is constant; ") + name +
                              " is black and white, as metallic usually is",
                          image_fix(material, map, "swap the channels",
                                    "--ch " + shell_word(swapped(texels, *material.channel(use), c)))});
      return;
    }
  });
}

void normal_space(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                  std::vector<MaterialFinding>& findings) {
  for_uses(material, [&](const MaterialUse& use) {
    const auto rgb = use.role == Role::kNormal ? material.colors(use) : std::vector<const Plane*>{};
    if (rgb.empty() || material.texels(use)->has_floats()) return;
    const NormalShares shares = normals_of(rgb);
    constexpr double kUnit = 0.8, kInwards = 0.1;
    if (shares.unit < kUnit || shares.inwards < kInwards) return;
    findings.push_back({rule.name, Confidence::kLikely, material.maps[use.map].shown, "",
                        percent(shares.inwards) + " of the normals point into the surface, so the map is in "
                                                  "world space or object space, not in tangent space",
                        "bake the map again in tangent space, because texremap cannot convert it"});
  });
}

void normal_orientation(const CheckedMaterial& material, const GltfConsumer* reader, const Rule& rule,
                        std::vector<MaterialFinding>& findings) {
  for_uses(material, [&](const MaterialUse& use) {
    const auto rgb = use.role == Role::kNormal ? material.colors(use) : std::vector<const Plane*>{};
    const MaterialMap& map = material.maps[use.map];
    const Orientation name = claimed(material, map, reader);
    if (rgb.empty() || name == Orientation::kUnknown || normals_of(rgb).unit < 0.8) return;
    const TexelSample& texels = *material.texels(use);
    MaterialUse green = use;
    green.channels = Channels::kGreen;
    const Orientation seen = seen_orientation(rgb, texels.columns, texels.rows);
    if (seen == Orientation::kUnknown || seen == name) return;
    const auto text = [](Orientation orientation) {
      return std::string(orientation == Orientation::kOpenGl ? "OpenGL (green up)" : "DirectX (green down)");
    };
    findings.push_back(
        {rule.name, Confidence::kLikely, map.shown, "G",
         "its slopes fit together only if it is " + text(seen) + ", but " +
             (material.kind == MaterialKind::kGltf ? "glTF has " : "its name or importer states ") +
             text(name),
         image_fix(material, map, "invert its green channel", inversion_of(material, green))});
  });
}

void wrong_texture(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                   std::vector<MaterialFinding>& findings) {
  const auto add = [&](const MaterialUse& use, Confidence confidence, const std::string& what) {
    findings.push_back({rule.name, confidence, material.maps[use.map].shown, "",
                        "is used as " + std::string(role_name(use.role)) + ", but " + what,
                        use.slot.empty()
                            ? "give the map a name that states what it holds, or replace it by a map of " +
                                  std::string(role_name(use.role))
                            : "point " + use.slot + " in " + material.path.filename().string() +
                                  " to the image of " + std::string(role_name(use.role))});
  };
  std::set<std::size_t> named;
  for (const MaterialUse& use : material.uses)
    for (const MaterialUse& other : material.uses) {
      const bool clash =
          use.map == other.map && is_data_role(use.role) && use.channels != Channels::kAlpha &&
          (is_color_role(other.role) || (other.role == Role::kNormal && use.role != Role::kNormal)) &&
          other.channels != Channels::kAlpha && other.role != Role::kSpecular;
      if (clash && !use.is_neighbour && !other.is_neighbour && named.insert(use.map).second)
        add(use, Confidence::kCertain, "the same image is used as " + std::string(role_name(other.role)));
    }
  for_uses(material, [&](const MaterialUse& use) {
    if (named.contains(use.map)) return;
    const TexelSample& texels = *material.texels(use);
    if (texels.channels.size() < 3 || texels.has_floats()) return;
    const MaterialUse whole{use.role, use.map, Channels::kRgb, "", {}, "", false};
    const auto rgb = material.colors(whole);
    if (rgb.empty() || std::ranges::all_of(rgb, [](const Plane* plane) { return is_constant(*plane); }))
      return;
    const NormalShares shares = normals_of(rgb);
    const bool looks_like_normals = shares.unit > 0.97 && shares.inwards < 0.01 && shares.mean[2] > 0.85;
    if (use.role != Role::kNormal && use.role != Role::kOther && looks_like_normals &&
        named.insert(use.map).second)
      add(use, Confidence::kLikely, "its texels are tangent-space normals");
    const bool has_blue = !is_constant(*rgb[2]);  // maps of two channels have no blue
    if (use.role == Role::kNormal && shares.unit < 0.3 && has_blue && named.insert(use.map).second)
      add(use, Confidence::kLikely, percent(1.0 - shares.unit) + " of its texels are not unit vectors");
  });
}

}  // namespace remap::look
