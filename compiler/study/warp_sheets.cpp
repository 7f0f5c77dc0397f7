#include "study/warp_sheets.hpp"

#include <algorithm>

#include "report/contact_sheet.hpp"
#include "report/shaded_map.hpp"

namespace remapc {
namespace {

constexpr int kSide = 256;        // width and height of a picture in pixels
constexpr std::size_t kZoom = 4;  // of figure 3

// One set of a study, as its sheets show it.
struct Shown {
  const WarpCase& studied;
  const WarpsResult& result;
  std::size_t set = 0;
  PictureGrid grid;

  const WarpRow& row(std::size_t stroke_set, std::size_t variant) const {
    return *std::find_if(result.rows.begin(), result.rows.end(), [&](const WarpRow& row) {
      return row.set == set && row.stroke_set == stroke_set && row.variant == variant;
    });
  }
  const WarpRow& row(std::size_t stroke_set, WarpGroup group, const std::string& name) const {
    return row(stroke_set, variant_named(result, group, name));
  }
  std::vector<remap::WarpTexel> texels_of(const TexelCopy& copy) const {
    std::vector<remap::WarpTexel> texels;
    for (const std::uint32_t texel : copy) texels.push_back(studied.target.texels[texel]);
    return texels;
  }
  Image lit_source() const {
    return shaded_map(grid, samples_of(grid, studied.source.texels), studied.source.model);
  }
  // Shades texels with the template's reflectance model.
  Image lit(const std::vector<remap::WarpTexel>& texels) const {
    return shaded_map(grid, samples_of(grid, texels), studied.target.model);
  }
};

// Shows distances as colors from black over red and yellow to white (100 %).
Image distance_picture(const PictureGrid& grid, const std::vector<double>& distances) {
  Image picture = blank_picture(grid.width, grid.height, 0.0f);
  const auto step = static_cast<std::size_t>(grid.samples), columns = grid.sample_width();
  std::vector<double> sums(picture.values.size() / 3, 0.0);
  for (std::size_t i = 0; i < grid.texels.size(); ++i)
    sums[i / columns / step * static_cast<std::size_t>(grid.width) + i % columns / step] +=
        distances[grid.texels[i]] / static_cast<double>(step * step);
  for (std::size_t p = 0; p < sums.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c)
      picture.values[3 * p + c] =
          static_cast<float>(std::clamp(3.0 * sums[p] / 100.0 - static_cast<double>(c), 0.0, 1.0));
  return picture;
}

WarpSheet methods_sheet(const Shown& shown, const WarpMeasures& measures) {
  const auto add = [&](const WarpRow& row, std::vector<std::vector<Image>>* rows) {
    (*rows)[1].push_back(shown.lit(shown.texels_of(row.copy)));
    (*rows)[2].push_back(distance_picture(shown.grid, measures.distances(row.copy)));
  };
  const WarpCase& studied = shown.studied;
  std::vector<std::vector<Image>> rows(3);
  const Image source = shown.lit_source(), target = shown.lit(studied.target.texels);
  rows[0] = {source, target, shown.lit(studied.truth),
             with_strokes(source, shown.grid, studied.strokes[0], &StrokePair::source),
             with_strokes(target, shown.grid, studied.strokes[0], &StrokePair::target)};
  for (const char* name : {"registration", "paper", "histogram", "affine", "nearest"})
    add(shown.row(0, WarpGroup::kMethod, name), &rows);
  for (const char* name : {"1", "2"}) add(shown.row(0, WarpGroup::kDimensions, name), &rows);
  return {
      "warp_methods_" + studied.name,
      "source, template, truth, source and template with strokes; registration, paper, histogram, affine, "
      "nearest texel without a warp, one dimension, two dimensions; distances to the truth (white: 100 %)",
      sheet_of(rows)};
}

WarpSheet sampling_sheet(const Shown& shown) {
  // Magnifies the center of the map.
  Shown part = shown;
  const WarpCase& studied = shown.studied;
  const std::size_t width = std::max<std::size_t>(studied.width / kZoom, 1),
                    height = std::max<std::size_t>(studied.height / kZoom, 1);
  part.grid = picture_grid(width, height, kSide);
  const std::size_t left = (studied.width - width) / 2, top = (studied.height - height) / 2;
  for (std::uint32_t& texel : part.grid.texels)
    texel = static_cast<std::uint32_t>((top + texel / width) * studied.width + left + texel % width);
  std::vector<std::vector<Image>> rows(2);
  std::string points, nodes;
  for (std::size_t v = 0; v < shown.result.variants.size(); ++v) {
    const WarpVariant& variant = shown.result.variants[v];
    if (variant.group == WarpGroup::kPoints) {
      rows[0].push_back(part.lit(part.texels_of(part.row(0, v).copy)));
      points += (points.empty() ? "" : ", ") + variant.name;
    } else if (variant.group == WarpGroup::kNodes) {
      rows[1].push_back(part.lit(part.row(0, v).converted));
      nodes += (nodes.empty() ? "" : ", ") + variant.name;
    }
  }
  rows[0].push_back(part.lit(studied.truth));
  rows[1].push_back(part.lit(part.texels_of(part.row(0, WarpGroup::kMethod, "registration").copy)));
  return {"warp_sampling_" + studied.name,
          "center, magnified: " + points + " points, truth; the converter with " + nodes +
              " times the default nodes, the exact copy",
          sheet_of(rows)};
}

WarpSheet strokes_sheet(const Shown& shown) {
  const WarpCase& studied = shown.studied;
  const Image source = shown.lit_source();
  const Image target = shown.lit(studied.target.texels);
  std::vector<std::vector<Image>> rows(5);
  for (std::size_t s = 0; s < studied.strokes.size(); ++s) {
    rows[0].push_back(with_strokes(source, shown.grid, studied.strokes[s], &StrokePair::source));
    rows[1].push_back(with_strokes(target, shown.grid, studied.strokes[s], &StrokePair::target));
    std::size_t r = 2;
    for (const char* name : {"registration", "paper", "affine"})
      rows[r++].push_back(shown.lit(shown.texels_of(shown.row(s, WarpGroup::kMethod, name).copy)));
  }
  return {"warp_strokes_" + studied.name,
          "one column per set of strokes: source with strokes, template with strokes, registration, paper, "
          "affine",
          sheet_of(rows)};
}

}  // namespace

std::vector<WarpSheet> warp_sheets(const WarpsOptions& options, const WarpsResult& result) {
  std::vector<WarpSheet> sheets;
  for (std::size_t set = 0; set < options.cases.size(); ++set) {
    const WarpCase& studied = options.cases[set];
    const Shown shown{studied, result, set, picture_grid(studied.width, studied.height, kSide)};
    sheets.push_back(methods_sheet(shown, WarpMeasures(studied)));
    sheets.push_back(sampling_sheet(shown));
    sheets.push_back(strokes_sheet(shown));
  }
  return sheets;
}

}  // namespace remapc
