#include "report/warp_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base64.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "look/image.hpp"
#include "report/contact_sheet.hpp"
#include "warp/coordinates.hpp"

namespace remap {
namespace {

constexpr int kSide = 512;  // in pixels
constexpr std::size_t kMostPoints = 16384, kMostStrokePoints = 512;
constexpr DisplayColor kGrey = {0.72f, 0.72f, 0.72f};

// A PlottedPoints holds points of one kind. Later points cover earlier ones.
struct PlottedPoints {
  Points positions;                  // the first two coordinates are drawn; rows with NaN are skipped
  std::vector<DisplayColor> colors;  // one color per point, or one color for all points
  double radius = 1.0;               // in pixels
};

// A PlotBox is the visible part of the plane.
struct PlotBox {
  double x = 0.0, y = 0.0;  // centre
  double half_width = 1.0, half_height = 1.0;
};

constexpr float kPlotPaper = 0.97f, kLine = 0.85f;

// Returns the first two coordinates of row `i`.
std::array<double, 2> place_of(const Points& positions, Eigen::Index i) {
  const double golden = 0.6180339887498949 * static_cast<double>(i);
  return {positions(i, 0), positions.cols() > 1 ? positions(i, 1) : golden - std::floor(golden) - 0.5};
}

// Draws an antialiased disc.
void draw_disc(double x, double y, double radius, const DisplayColor& color, Image* picture) {
  const int left = std::max(static_cast<int>(std::floor(x - radius - 1.0)), 0);
  const int right = std::min(static_cast<int>(std::ceil(x + radius + 1.0)), picture->width - 1);
  const int top = std::max(static_cast<int>(std::floor(y - radius - 1.0)), 0);
  const int bottom = std::min(static_cast<int>(std::ceil(y + radius + 1.0)), picture->height - 1);
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column) {
      const double distance = std::hypot(column + 0.5 - x, row + 0.5 - y);
      const auto cover = static_cast<float>(std::clamp(radius + 0.5 - distance, 0.0, 1.0));
      float* pixel = &picture->values[3 * static_cast<std::size_t>(row * picture->width + column)];
      for (std::size_t c = 0; c < 3; ++c) pixel[c] += cover * (color[c] - pixel[c]);
    }
}

void draw_lines(const PlotBox& box, double scale, Image* picture) {
  const auto column = static_cast<int>(std::floor((box.half_width - box.x) * scale));
  const auto row = static_cast<int>(std::floor((box.half_height + box.y) * scale));
  const auto mark = [&](int x, int y) {
    std::fill_n(&picture->values[3 * static_cast<std::size_t>(y * picture->width + x)], 3, kLine);
  };
  for (int y = 0; y < picture->height && column >= 0 && column < picture->width; ++y) mark(column, y);
  for (int x = 0; x < picture->width && row >= 0 && row < picture->height; ++x) mark(x, row);
}

// Returns the bounding box of all layers, enlarged by a twentieth, with an aspect ratio of 1:1 to 3:1.
PlotBox box_around(const std::vector<PlottedPoints>& layers) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const PlottedPoints& layer : layers)
    for (Eigen::Index i = 0; i < layer.positions.rows(); ++i) {
      const std::array<double, 2> place = place_of(layer.positions, i);
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], place[k]);  // comparisons with NaN change neither `low` nor `high`
        high[k] = std::max(high[k], place[k]);
      }
    }
  if (!(low[0] <= high[0] && low[1] <= high[1])) return {};
  const double height = high[1] - low[1], width = std::max({high[0] - low[0], height, 1e-6});
  return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.525 * width,
          0.525 * std::max(height, width / 3.0)};
}

// Draws the layers kSide pixels wide, with the aspect ratio of the box. The second coordinate points up. If
// points have only one dimension, they are spread along it to be visible. Lines mark the zeros.
Image appearance_plot(const std::vector<PlottedPoints>& layers, const PlotBox& box) {
  const double scale = 0.5 * kSide / box.half_width;
  Image picture =
      blank_picture(kSide, static_cast<int>(std::lround(2.0 * scale * box.half_height)), kPlotPaper);
  draw_lines(box, scale, &picture);
  for (const PlottedPoints& layer : layers)
    for (Eigen::Index i = 0; i < layer.positions.rows(); ++i) {
      const std::array<double, 2> place = place_of(layer.positions, i);
      if (!std::isfinite(place[0]) || !std::isfinite(place[1])) continue;
      const double x = (place[0] - box.x + box.half_width) * scale;
      const double y = (box.half_height - place[1] + box.y) * scale;
      const std::size_t color = layer.colors.size() == 1 ? 0 : static_cast<std::size_t>(i);
      if (std::abs(x) < 1e6 && std::abs(y) < 1e6)
        draw_disc(x, y, layer.radius, layer.colors[color], &picture);
    }
  return picture;
}

std::vector<WarpTexel> texels_at(const WarpMaterial& material, const std::vector<std::uint32_t>& indices,
                                 std::size_t most) {
  std::vector<WarpTexel> texels;
  const std::size_t count = std::min(indices.size(), most);
  for (std::size_t i = 0; i < count; ++i)
    texels.push_back(material.texels[indices[i * indices.size() / count]]);
  return texels;
}

// Returns the points of a material in its space: its texels, and then each of its strokes.
std::vector<PlottedPoints> layers_of(const WarpMaterial& material, const AppearanceCoordinates& coordinates,
                                     const std::vector<StrokePair>& strokes, StrokeSide side) {
  const std::vector<WarpTexel> texels =
      texels_at(material, sample_texels(material, kMostPoints), kMostPoints);
  std::vector<PlottedPoints> layers{{positions_of(coordinates, texels), {}, 0.8}};
  for (const WarpTexel& texel : texels) layers.front().colors.push_back(shaded_color(texel, material.model));
  for (std::size_t k = 0; k < strokes.size(); ++k)
    layers.push_back({positions_of(coordinates, texels_at(material, strokes[k].*side, kMostStrokePoints)),
                      {stroke_color(k)},
                      1.8});
  return layers;
}

std::vector<PlottedPoints> moved(std::vector<PlottedPoints> layers, const SmoothWarp& warp) {
  for (PlottedPoints& layer : layers) layer.positions = images_of(warp, layer.positions);
  return layers;
}

// Draws the source's points over the template's texels.
std::vector<PlottedPoints> over_grey(const PlottedPoints& texels, const std::vector<PlottedPoints>& layers) {
  std::vector<PlottedPoints> all{{texels.positions, {kGrey}, 1.6}};
  all.insert(all.end(), layers.begin(), layers.end());
  return all;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += letter;
    }
  return result;
}

std::string figure_html(const Image& picture, const std::string& caption) {
  return "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," +
         base64(png_bytes(picture)) + "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string stroke_key(std::size_t stroke_count) {
  std::string text = "<p>Strokes:";
  for (std::size_t k = 0; k < stroke_count; ++k) {
    const DisplayColor& color = stroke_color(k);
    text += " <span class=\"key\" style=\"background:rgb(";
    for (std::size_t c = 0; c < 3; ++c)
      text += (c == 0 ? "" : ",") + std::to_string(static_cast<int>(255.0f * color[c]));
    text += ")\"></span> " + std::to_string(k + 1);
  }
  return text + "</p>\n";
}

constexpr const char* kHead =
    "<meta charset=\"utf-8\">\n<style>\n"
    "body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 1180px; padding: 0 1em; color: #222 }\n"
    ".row { display: grid; grid-template-columns: repeat(auto-fill, minmax(340px, 1fr)); gap: 14px }\n"
    ".small { grid-template-columns: repeat(auto-fill, minmax(250px, 1fr)) }\n"
    "figure { margin: 0 } img { width: 100%; display: block }\n"
    "figcaption { color: #555; font-size: 13px; padding: 4px 0 10px }\n"
    "table { border-collapse: collapse; margin: 1em 0 } td { padding: 2px 18px 2px 0 }\n"
    ".warning { background: #fff3d6; border-left: 4px solid #e69f00; padding: 6px 12px; margin: 8px 0 }\n"
    ".key { display: inline-block; width: 0.9em; height: 0.9em; margin-left: 0.7em }\n"
    "</style>\n";

std::string report_html(const WarpReport& report) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<title>" + escaped(report.title) +
                     "</title>\n" + kHead + "</head>\n<body>\n<h1>" + escaped(report.title) + "</h1>\n";
  for (const std::string& warning : report.warnings)
    html += "<p class=\"warning\">" + escaped(warning) + "</p>\n";
  html += "<div class=\"row\">\n" + figure_html(report.source, "Source") +
          figure_html(report.target, "Template") +
          figure_html(report.result, "Result: pattern of the source, reflectance of the template") +
          "</div>\n<h2>Strokes</h2>\n" + stroke_key(report.stroke_count) + "<div class=\"row\">\n" +
          figure_html(report.source_strokes, "Strokes on the source") +
          figure_html(report.target_strokes, "Strokes on the template") +
          "</div>\n<h2>Appearance spaces</h2>\n<p>The first two coordinates. Each point is a texel in its "
          "color; texels of strokes have the colors of the strokes.</p>\n<div class=\"row small\">\n" +
          figure_html(report.source_space, "Source") + figure_html(report.target_space, "Template") +
          figure_html(report.before, "Before the warp: source over template (grey)") +
          figure_html(report.after, "After the warp") + "</div>\n<h2>Figures</h2>\n<table>\n";
  for (const auto& [name, value] : report.facts)
    html += "<tr><td>" + escaped(name) + "</td><td>" + escaped(value) + "</td></tr>\n";
  return html +
         "</table>\n<p>Maps are shown on a cushion under a key light from the upper left, a weaker light "
         "from the lower right and uniform surroundings. Highlights are as wide as the material's lobe.</p>\n"
         "</body>\n</html>\n";
}

}  // namespace

WarpReport warp_report(const WarpMaterial& source, const WarpMaterial& target,
                       const std::vector<StrokePair>& strokes, const WarpFit& fit) {
  const PictureGrid from = picture_grid(source.width, source.height, kSide);
  const PictureGrid to = picture_grid(target.width, target.height, kSide);
  std::vector<WarpTexel> samples = samples_of(from, source.texels);
  WarpReport report;
  report.stroke_count = strokes.size();
  report.source = shaded_map(from, samples, source.model);
  report.target = shaded_map(to, samples_of(to, target.texels), target.model);
  for (WarpTexel& sample : samples) sample = evaluate_warp(fit.compiled, sample);
  report.result = shaded_map(from, samples, target.model);
  report.source_strokes = with_strokes(report.source, from, strokes, &StrokePair::source);
  report.target_strokes = with_strokes(report.target, to, strokes, &StrokePair::target);

  const std::vector<PlottedPoints> own =
      layers_of(source, fit.compiled.coordinates, strokes, &StrokePair::source);
  const std::vector<PlottedPoints> goal =
      layers_of(target, fit.target_coordinates(), strokes, &StrokePair::target);
  const std::vector<PlottedPoints> before = over_grey(goal.front(), own),
                                   after = over_grey(goal.front(), moved(own, fit.warp));
  std::vector<PlottedPoints> all = before;
  all.insert(all.end(), after.begin(), after.end());
  const PlotBox box = box_around(all);
  report.source_space = appearance_plot(own, box);
  report.target_space = appearance_plot(goal, box);
  report.before = appearance_plot(before, box);
  report.after = appearance_plot(after, box);
  return report;
}

void require_report_path(const std::filesystem::path& path) {
  if (path.extension() != ".html")
    throw usage_error("--report " + path.string() + ": the file name must end with .html");
}

void write_warp_report(const std::filesystem::path& path, const WarpReport& report) {
  write_file(path, report_html(report));
}

}  // namespace remap
