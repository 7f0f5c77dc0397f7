#include "warp/strokes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "warp/texture_material.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

// Returns for example `96x64`.
std::string size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// Calls use(values, is_alpha) for each channel in the order of the file. Values are as channel_values() gives
// them. Throws kInput if the image cannot be read or its size differs from the material's.
void read_stroke_image(const fs::path& image, const MaterialRef& material, const auto& use) {
  ImageReader reader(image);
  const ImageLayout& layout = reader.layout();
  const auto width = static_cast<std::size_t>(layout.width), height = static_cast<std::size_t>(layout.height);
  if (width != material.width() || height != material.height())
    throw input_error(image.string() + ": size " + size_text(width, height) + " does not match the maps of " +
                      material.name() + " (" + size_text(material.width(), material.height()) +
                      ") (make the image " + size_text(material.width(), material.height()) + ")");
  const std::vector<std::byte> texels = texels_of(reader);
  for (std::size_t c = 0; c < layout.channels.size(); ++c)
    use(channel_values(layout, c, texels), static_cast<int>(c) == layout.alpha_channel);
}

// Throws kInput with the name of the image if `marked` is more than three quarters of the texels. Such an
// image is most likely inverted.
void require_background(const fs::path& image, std::size_t marked, const MaterialRef& material) {
  if (4 * marked > 3 * material.width() * material.height())
    throw input_error(
        image.string() +
        ": strokes cover more than three quarters of the image (check that the image is not inverted)");
}

using Color = std::uint32_t;  // 0xRRGGBB
constexpr Color kTransparent = Color{1} << 24;

constexpr double kColorRadius = 40.0;  // colors within this distance are treated as one
constexpr double kPairRadius = 48.0;   // colors of two images match within this distance
// JPEG compression creates shades of the background next to strokes. This is their largest distance from the
// background color.
constexpr double kShadeRadius = 80.0;
constexpr double kBlendRadius = 60.0;  // greatest distance of a blend from the line between its two colors
constexpr double kMostBlends = 0.4;    // greatest fraction of texels that blend; thin strokes have long edges
constexpr double kLeastColorShare = 2e-5;     // least fraction of the texels for a color
constexpr std::size_t kLeastColorTexels = 8;  // least number of texels for a color
constexpr std::size_t kMostColors = 33;       // including the background
constexpr std::size_t kMostCandidates = 128;

using Point = std::array<double, 3>;
Point point_of(Color color) {
  return {static_cast<double>(color >> 16 & 255), static_cast<double>(color >> 8 & 255),
          static_cast<double>(color & 255)};
}

double distance(Color a, Color b) {
  const Point p = point_of(a), q = point_of(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

// Returns the distance of `color` to the line segment between two others.
double distance_to_blends(Color color, Color a, Color b) {
  const Point p = point_of(color), q = point_of(a), r = point_of(b);
  double along = 0.0, length = 0.0, square = 0.0;
  for (std::size_t c = 0; c < p.size(); ++c) {
    along += (p[c] - q[c]) * (r[c] - q[c]);
    length += (r[c] - q[c]) * (r[c] - q[c]);
  }
  const double t = length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
  for (std::size_t c = 0; c < p.size(); ++c) square += std::pow(p[c] - q[c] - t * (r[c] - q[c]), 2.0);
  return std::sqrt(square);
}

std::string text_of(Color color) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%06x", color & 0xffffffu);
  return text.data();
}

// A Painting holds the texels of an image as 8-bit colors.
struct Painting {
  fs::path path;
  std::size_t width = 0;
  std::vector<Color> texels;  // kTransparent if alpha is below 0.5
};

Painting read_painting(const fs::path& path, const MaterialRef& material) {
  Painting painting{path, material.width(), std::vector<Color>(material.width() * material.height(), 0)};
  std::vector<char> is_transparent(painting.texels.size(), 0);
  unsigned colors = 0;
  read_stroke_image(path, material, [&](const std::vector<float>& values, bool is_alpha) {
    if (!is_alpha && ++colors > 3) return;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float value = values[i] > 0.0f ? std::min(values[i], 1.0f) : 0.0f;  // NaN becomes black
      if (is_alpha)
        is_transparent[i] = value < 0.5f ? 1 : 0;
      else
        painting.texels[i] |= static_cast<Color>(value * 255.0f + 0.5f) << (8 * (3 - colors));
    }
  });
  for (std::size_t i = 0; i < painting.texels.size(); ++i) {
    if (colors < 3) painting.texels[i] = (painting.texels[i] >> 16) * 0x010101u;  // grey
    if (is_transparent[i] != 0) painting.texels[i] = kTransparent;
  }
  return painting;
}

// A ColorCount is one color, or the most frequent of the colors that are treated as one.
struct ColorCount {
  Color color = 0;
  std::size_t texels = 0;
};

bool is_more_frequent(const ColorCount& a, const ColorCount& b) { return a.texels > b.texels; }

// Returns the colors of the image, the most frequent first.
std::vector<ColorCount> frequencies(const Painting& painting) {
  std::vector<std::uint32_t> counts(kTransparent + 1, 0);
  for (const Color color : painting.texels) ++counts[color];
  std::vector<ColorCount> found;
  for (Color color = 0; color < kTransparent; ++color)
    if (counts[color] > 0) found.push_back({color, counts[color]});
  std::ranges::stable_sort(found, is_more_frequent);
  return found;
}

// Forms each cluster around the most frequent color that is in no previous cluster. Returns the largest
// cluster first.
std::vector<ColorCount> clusters_of(const std::vector<ColorCount>& colors, std::size_t least_texels) {
  std::vector<char> taken(colors.size(), 0);
  std::vector<ColorCount> clusters;
  for (std::size_t i = 0, candidates = 0; i < colors.size() && candidates < kMostCandidates; ++i) {
    if (taken[i] != 0) continue;
    ++candidates;
    ColorCount cluster{colors[i].color, 0};
    for (std::size_t k = i; k < colors.size(); ++k) {
      if (taken[k] != 0 || distance(colors[k].color, cluster.color) > kColorRadius) continue;
      taken[k] = 1;
      cluster.texels += colors[k].texels;
    }
    if (cluster.texels >= least_texels) clusters.push_back(cluster);
  }
  std::ranges::stable_sort(clusters, is_more_frequent);
  return clusters;
}

constexpr std::uint8_t kNoCluster = 255;

// Returns the index of the closest cluster for each texel, or kNoCluster.
std::vector<std::uint8_t> labels_of(const Painting& painting, const std::vector<ColorCount>& colors,
                                    const std::vector<ColorCount>& clusters) {
  std::vector<std::uint8_t> label_of_color(kTransparent + 1, kNoCluster);
  for (const ColorCount& entry : colors) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      const double d = distance(entry.color, clusters[c].color);
      if (d > kColorRadius || d >= nearest) continue;
      nearest = d;
      label_of_color[entry.color] = static_cast<std::uint8_t>(c);
    }
  }
  std::vector<std::uint8_t> labels(painting.texels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = label_of_color[painting.texels[i]];
  return labels;
}

// A Surroundings holds statistics of the surroundings of the texels of one cluster.
struct Surroundings {
  double count = 0.0;
  double flat = 0.0;    // texels with three or more neighbors of the same cluster
  double beside = 0.0;  // texels with another stroke within six texels
  double at_rim = 0.0;  // texels with a larger stroke within six texels
  double close = 0.0;   // texels with a larger stroke within two texels
  // This counts, for each stroke, the texels for which it is the largest stroke within six texels.
  std::array<std::size_t, kNoCluster + 1> rims = {};
};

// Searches in eight directions, as far as blurred edges of strokes extend.
void look_around(const std::vector<std::uint8_t>& labels, std::size_t width, std::size_t texel,
                 std::size_t first_stroke, Surroundings& found) {
  const std::uint8_t own = labels[texel];
  const auto columns = static_cast<std::ptrdiff_t>(width),
             rows = static_cast<std::ptrdiff_t>(labels.size() / width);
  const auto x = static_cast<std::ptrdiff_t>(texel) % columns,
             y = static_cast<std::ptrdiff_t>(texel) / columns;
  int alike = 0;
  bool beside = false, close = false;
  std::uint8_t larger = kNoCluster;
  for (const std::ptrdiff_t reach : {1, 2, 4, 6})
    for (std::ptrdiff_t direction = 0; direction < 9; ++direction) {
      const std::ptrdiff_t u = x + reach * (direction % 3 - 1), v = y + reach * (direction / 3 - 1);
      if (direction == 4 || u < 0 || v < 0 || u >= columns || v >= rows) continue;
      const std::uint8_t other = labels[static_cast<std::size_t>(v * columns + u)];
      if (other == own && reach == 1) ++alike;
      if (other == own || other < first_stroke || other == kNoCluster) continue;
      beside = true;
      if (other > own) continue;
      larger = std::min(larger, other);
      close = close || reach <= 2;
    }
  found.count += 1.0;
  found.flat += alike >= 3 ? 1.0 : 0.0;
  found.beside += beside ? 1.0 : 0.0;
  found.close += close ? 1.0 : 0.0;
  if (larger == kNoCluster) return;
  found.at_rim += 1.0;
  ++found.rims[larger];
}

// Returns true if a cluster is the edge of a larger stroke. Such a cluster is thin, or it is a blend with the
// background along the whole stroke. Also returns true for a shade of the background next to strokes, which
// JPEG produces.
bool is_rim(const std::vector<ColorCount>& clusters, std::size_t index, const Surroundings& around,
            std::size_t first_stroke) {
  if (around.close > 0.75 * around.count && around.flat < 0.4 * around.count) return true;
  if (first_stroke == 0) return false;
  const Color color = clusters[index].color, background = clusters.front().color;
  if (distance(color, background) < kShadeRadius && around.beside > 0.25 * around.count) return true;
  if (around.at_rim < 0.75 * around.count) return false;
  const auto most = std::ranges::max_element(around.rims) - around.rims.begin();
  return distance_to_blends(color, background, clusters[static_cast<std::size_t>(most)].color) < kBlendRadius;
}

struct ColorStroke {
  Color color = 0;
  std::vector<std::uint32_t> texels;
};

[[noreturn]] void fail_not_flat(const Painting& painting, const std::string& what) {
  throw input_error(painting.path.string() + ": " + what +
                    " (paint strokes in a few flat colors with a hard brush, on a plain black, white or "
                    "transparent background)");
}

// Removes the clusters that are edges of strokes. `first_stroke` is the first cluster after the background.
std::vector<ColorCount> without_rims(const std::vector<ColorCount>& clusters, const Painting& painting,
                                     const std::vector<std::uint8_t>& labels, std::size_t first_stroke) {
  std::vector<Surroundings> around(clusters.size());
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] != kNoCluster && labels[i] >= first_stroke)
      look_around(labels, painting.width, i, first_stroke, around[labels[i]]);
  std::vector<ColorCount> kept;
  for (std::size_t c = 0; c < clusters.size(); ++c)
    if (c < first_stroke || !is_rim(clusters, c, around[c], first_stroke)) kept.push_back(clusters[c]);
  return kept;
}

// Returns the strokes of an image, in the order of their first texels.
std::vector<ColorStroke> strokes_in(const Painting& painting, const MaterialRef& material) {
  const auto count = static_cast<double>(painting.texels.size());
  const auto transparent = static_cast<double>(std::ranges::count(painting.texels, kTransparent));
  const std::size_t first_stroke = transparent >= 0.01 * count ? 0 : 1;
  const std::vector<ColorCount> colors = frequencies(painting);
  const std::size_t least = std::max(kLeastColorTexels, static_cast<std::size_t>(kLeastColorShare * count));
  const std::vector<ColorCount> all = clusters_of(colors, least);
  const std::vector<ColorCount> kept =
      without_rims(all, painting, labels_of(painting, colors, all), first_stroke);
  if (kept.size() > kMostColors) fail_not_flat(painting, "has more than 32 colors");
  const std::vector<std::uint8_t> labels = labels_of(painting, colors, kept);
  std::vector<ColorStroke> strokes(kept.size());
  std::size_t marked = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoCluster || labels[i] < first_stroke) continue;
    strokes[labels[i]].texels.push_back(static_cast<std::uint32_t>(i));
    ++marked;
  }
  const auto blends = static_cast<double>(std::ranges::count(labels, kNoCluster)) - transparent;
  if (blends > kMostBlends * count)
    fail_not_flat(painting, percent(blends / count) + " of the texels are not in one of the flat colors");
  for (std::size_t c = 0; c < kept.size(); ++c) strokes[c].color = kept[c].color;
  std::erase_if(strokes, [](const ColorStroke& stroke) { return stroke.texels.empty(); });
  if (strokes.empty()) fail_not_flat(painting, "contains no stroke");
  require_background(painting.path, marked, material);
  std::ranges::sort(strokes, [](const ColorStroke& a, const ColorStroke& b) {
    return a.texels.front() < b.texels.front();
  });
  return strokes;
}

// Returns the index of the stroke with the closest color.
std::size_t nearest_stroke(const std::vector<ColorStroke>& strokes, Color color) {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < strokes.size(); ++k)
    if (distance(strokes[k].color, color) < distance(strokes[nearest].color, color)) nearest = k;
  return nearest;
}

// Throws kInput if a stroke of `strokes` has no partner in `others`. Each of two partners must have the
// closest color to the other.
void require_partners(const std::vector<ColorStroke>& strokes, const fs::path& image,
                      const std::vector<ColorStroke>& others, const fs::path& other_image) {
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    const ColorStroke& nearest = others[nearest_stroke(others, strokes[k].color)];
    if (nearest_stroke(strokes, nearest.color) == k &&
        distance(nearest.color, strokes[k].color) <= kPairRadius)
      continue;
    throw input_error(other_image.string() + ": has no stroke with color " + text_of(strokes[k].color) +
                      " of " + image.string() + " (the closest is " + text_of(nearest.color) +
                      "; every color must be in both images)");
  }
}

}  // namespace

std::vector<std::uint32_t> read_stroke(const std::filesystem::path& mask, const MaterialRef& material) {
  std::vector<char> marked(material.width() * material.height(), 0);
  read_stroke_image(mask, material, [&](const std::vector<float>& values, bool is_alpha) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!is_alpha && values[i] > 0.5f) marked[i] = 1;
  });
  std::vector<std::uint32_t> stroke;
  for (std::uint32_t i = 0; i < marked.size(); ++i)
    if (marked[i] != 0) stroke.push_back(i);
  if (stroke.empty())
    throw input_error(mask.string() + ": the mask marks no texel (paint strokes brighter than 0.5)");
  require_background(mask, stroke.size(), material);
  return stroke;
}

std::vector<std::uint32_t> box_stroke(const std::string& box, const MaterialRef& material) {
  const auto fail = [&] {
    throw usage_error("--box: '" + box + "' is not a box within " +
                      size_text(material.width(), material.height()) +
                      " texels (use x0,y0,x1,y1 with x0 < x1 and y0 < y1)");
  };
  std::vector<std::size_t> corner;
  std::istringstream parts(box);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto number = parse_number(part);
    if (!number || !(*number >= 0.0 && *number <= 1e6)) fail();  // this also rejects "nan", which is a number
    corner.push_back(static_cast<std::size_t>(*number));
  }
  if (corner.size() != 4 || corner[0] >= corner[2] || corner[1] >= corner[3] ||
      corner[2] > material.width() || corner[3] > material.height())
    fail();
  std::vector<std::uint32_t> stroke;
  for (std::size_t y = corner[1]; y < corner[3]; ++y)
    for (std::size_t x = corner[0]; x < corner[2]; ++x)
      stroke.push_back(static_cast<std::uint32_t>(y * material.width() + x));
  return stroke;
}

std::vector<StrokePair> read_color_strokes(const fs::path& source_image, const MaterialRef& source,
                                           const fs::path& template_image, const MaterialRef& target) {
  std::vector<ColorStroke> from = strokes_in(read_painting(source_image, source), source);
  std::vector<ColorStroke> to = strokes_in(read_painting(template_image, target), target);
  require_partners(from, source_image, to, template_image);
  require_partners(to, template_image, from, source_image);
  std::vector<StrokePair> strokes(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    strokes[k].color = text_of(from[k].color);
    strokes[k].source = std::move(from[k].texels);
    strokes[k].target = std::move(to[nearest_stroke(to, from[k].color)].texels);
  }
  return strokes;
}

}  // namespace remap
