#include "warp/warp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/number_text.hpp"
#include "warp/decompositions.hpp"
#include "warp/warp_table.hpp"

namespace remap {
namespace {

// More texels of the template than of the source are used, because results are texels of the template, and
// the source only gives points.
constexpr std::size_t kMostSources = std::size_t{1} << 16, kMostTargets = std::size_t{1} << 18;

// These are the limits of copy_rms_error().
constexpr std::size_t kMostSampledSources = std::size_t{1} << 14, kMostCopies = std::size_t{1} << 18;

using StrokeTexels = std::vector<std::vector<std::uint32_t>>;

// A Selection holds the texels that the match uses, and strokes as indices into these texels.
struct Selection {
  std::vector<std::uint32_t> texels;
  StrokeTexels strokes;
  std::size_t left_out = 0;
};

Selection selection_of(const MaterialRef& material, const std::vector<StrokePair>& strokes,
                       std::vector<std::uint32_t> StrokePair::*side, std::size_t limit) {
  const std::size_t count = material.texel_count();
  std::vector<char> wanted(count, 0);
  const std::size_t step = (count + limit - 1) / limit;
  for (std::size_t i = 0, block = 0; i < count; i += step, ++block)
    // each step has another offset, so that samples do not form columns
    wanted[std::min(i + block * 61 % step, count - 1)] = 1;
  for (const StrokePair& stroke : strokes)
    for (const std::uint32_t texel : stroke.*side) wanted[texel] = 1;

  Selection result;
  std::vector<std::uint32_t> index(count, kNoTexel);
  for (std::size_t i = 0; i < count; ++i) {
    const bool takes_part = material.takes_part(i);
    if (!takes_part) ++result.left_out;
    if (!takes_part || wanted[i] == 0) continue;
    index[i] = static_cast<std::uint32_t>(result.texels.size());
    result.texels.push_back(static_cast<std::uint32_t>(i));
  }
  for (const StrokePair& stroke : strokes) {
    std::vector<std::uint32_t>& own = result.strokes.emplace_back();
    for (const std::uint32_t texel : stroke.*side)
      if (index[texel] != kNoTexel) own.push_back(index[texel]);
  }
  return result;
}

// Returns the number of directions in which the strokes' centres differ by over a tenth of the radius.
int fixed_directions(const Points& centres) {
  const Points centred = centres.rowwise() - centres.colwise().mean();
  const Eigen::VectorXd squares = symmetric_eigen(centred.transpose() * centred).values;
  return static_cast<int>((squares.array() > 0.01 * static_cast<double>(centres.rows())).count());
}

double rms_distance(const Points& a, const Points& b, std::size_t* worst = nullptr) {
  const Eigen::VectorXd squares = (a - b).rowwise().squaredNorm();
  Eigen::Index farthest = 0;
  squares.maxCoeff(&farthest);
  if (worst != nullptr) *worst = static_cast<std::size_t>(farthest);
  return std::sqrt(squares.mean());
}

// Returns the fraction of template points that have the image of a source point at a distance of at most one
// bin.
double coverage_of(const SmoothWarp& warp, const PointSets& sets) {
  const Points images = images_of(warp, sets.source.points);
  const Points& goal = sets.target.points;
  std::vector<char> used(static_cast<std::size_t>(goal.rows()), 0);
  for (Eigen::Index j = 0; j < goal.rows(); ++j) {
    const double distance = (images.rowwise() - goal.row(j)).rowwise().squaredNorm().minCoeff();
    used[static_cast<std::size_t>(j)] = distance < sets.target.spacing * sets.target.spacing ? 1 : 0;
  }
  return static_cast<double>(std::ranges::count(used, 1)) / static_cast<double>(used.size());
}

// Returns the largest overlap in either material.
Overlap largest_overlap(const MaterialRef& source, const MaterialRef& target,
                        const std::vector<StrokePair>& strokes) {
  Overlap most;
  for (std::size_t k = 0; k < strokes.size(); ++k)
    for (const bool in_template : {false, true}) {
      const Overlap overlap = in_template
                                  ? largest_overlap(strokes, &StrokePair::target, k, target.texel_count())
                                  : largest_overlap(strokes, &StrokePair::source, k, source.texel_count());
      if (overlap.share > most.share) most = overlap;
    }
  return most;
}

// Fills the diagnostics of the points and the warp.
void diagnose(const PointSets& sets, AppearanceMatch& match) {
  WarpDiagnostics& found = match.diagnostics;
  found.fixed_directions = fixed_directions(sets.source_centres);
  found.fold_share = fold_share(match.warp, sets.source.points, sets.source.texel_count);
  found.coverage = coverage_of(match.warp, sets);
  found.stroke_distance =
      rms_distance(images_of(match.warp, sets.source_centres), sets.target_centres, &found.worst_stroke);
  found.stroke_contradiction =
      rms_distance(images_of(affine_from_strokes(sets), sets.source_centres), sets.target_centres);
}

// Returns the material with only these texels, all of them in 0 to 1.
WarpMaterial reduced(const WarpMaterial& material, const std::vector<std::uint32_t>& texels) {
  WarpMaterial result{material.name, material.model, {}, material.is_dielectric};
  result.texels.reserve(texels.size());
  for (const std::uint32_t texel : texels) result.texels.push_back(clamped(material.texels[texel]));
  return result;
}

}  // namespace

AppearanceMatch match_appearances(const MaterialRef& source, const MaterialRef& target,
                                  const std::vector<StrokePair>& strokes, AppearanceDistance distance) {
  require_valid(source, target, strokes);
  const FeaturePair features = appearance_features(source, target, distance);
  const AppearanceSpace from_space = appearance_space(source, features.source);
  const AppearanceSpace to_space = appearance_space(target, features.target);

  AppearanceMatch match;
  WarpDiagnostics& found = match.diagnostics;
  found.shared = largest_overlap(source, target, strokes);
  for (std::size_t k = 0; k < strokes.size(); ++k) found.strokes.push_back(stroke_name(strokes, k));
  found.source_dimensions = dimension_of(from_space);
  found.target_dimensions = dimension_of(to_space);
  found.dimensions = std::max(found.source_dimensions, found.target_dimensions);
  const auto last = static_cast<std::size_t>(found.dimensions) - 1;
  found.source_stress = from_space.stress[last];
  found.target_stress = to_space.stress[last];

  match.source = placement_of(source, features.source, from_space, found.dimensions);
  match.target = placement_of(target, features.target, to_space, found.dimensions);
  match.target_radius = to_space.radius;
  found.coordinates_error = std::max(match.source.fit_error, match.target.fit_error);
  const Selection from = selection_of(source, strokes, &StrokePair::source, kMostSources);
  Selection to = selection_of(target, strokes, &StrokePair::target, kMostTargets);
  found.source_left_out = from.left_out;
  found.target_left_out = to.left_out;
  match.source_positions = positions_of(match.source, source, from.texels);
  match.target_positions = positions_of(match.target, target, to.texels);
  match.target_texels = std::move(to.texels);
  const PointSets sets = {occupancy_of(match.source_positions, from.strokes),
                          occupancy_of(match.target_positions, to.strokes),
                          common_axes(from_space, to_space, found.dimensions),
                          stroke_centres(match.source_positions, from.strokes),
                          stroke_centres(match.target_positions, to.strokes)};
  match.warp = register_points(sets, affine_from_strokes(sets));
  diagnose(sets, match);
  return match;
}

WarpFit fit_warp(const WarpMaterial& source, const WarpMaterial& target,
                 const std::vector<StrokePair>& strokes, AppearanceDistance distance, bool exact) {
  WarpFit fit{match_appearances(source, target, strokes, distance), {}};
  fit.compiled.coordinates = std::get<AppearanceCoordinates>(fit.source.coordinates);
  fit.compiled.table = compile_table(fit.warp, fit.source_positions, fit.target_positions,
                                     reduced(target, fit.target_texels), exact);
  return fit;
}

std::vector<std::uint32_t> copy_exactly(const AppearanceMatch& match, const MaterialRef& source,
                                        const MaterialRef& target) {
  Points goal = positions_of(match.target, target);
  for (std::size_t i = 0; i < target.texel_count(); ++i)
    if (!target.takes_part(i))
      goal.row(static_cast<Eigen::Index>(i)).setConstant(std::numeric_limits<double>::quiet_NaN());
  Points images = images_of(match.warp, positions_of(match.source, source));
  for (Eigen::Index i = 0; i < images.rows(); ++i)
    if (!images.row(i).allFinite()) images.row(i).setZero();
  std::vector<std::uint32_t> texels = nearest_texels(goal, images);
  for (std::size_t i = 0; i < texels.size(); ++i)
    if (!source.takes_part(i)) texels[i] = kNoTexel;
  return texels;
}

double copy_rms_error(const WarpFit& fit, const WarpMaterial& source, const WarpMaterial& target) {
  const WarpMaterial from = reduced(source, sample_texels(source, kMostSampledSources)),
                     to = reduced(target, sample_texels(target, kMostCopies));
  std::vector<WarpTexel> copied, compiled;
  for (const std::uint32_t texel : copy_exactly(fit, from, to)) copied.push_back(to.texels[texel]);
  for (const WarpTexel& texel : from.texels) compiled.push_back(evaluate_warp(fit.compiled, texel));
  // Coordinates are relative to the spread of the template.
  const Points difference =
      positions_of(fit.target_coordinates(), compiled) - positions_of(fit.target_coordinates(), copied);
  return std::sqrt(difference.rowwise().squaredNorm().mean());
}

std::vector<std::string> warnings_of(const WarpDiagnostics& found) {
  std::vector<std::string> warnings;
  if (found.source_left_out > 0 || found.target_left_out > 0)
    warnings.push_back(std::to_string(found.source_left_out) + " texels of the source and " +
                       std::to_string(found.target_left_out) +
                       " of the template are not finite and were skipped");
  if (found.coordinates_error > 0.03)
    warnings.push_back("positions in appearance space have an error of " + percent(found.coordinates_error) +
                       " of the spread: the distance is approximated poorly for these materials");
  if (found.shared.share > 0.5)
    warnings.push_back(found.strokes[found.shared.other] + " covers " + percent(found.shared.share) + " of " +
                       found.strokes[found.shared.stroke] + " in the " +
                       (found.shared.in_template ? "template" : "source") +
                       ": both mark the same region there (erase one of them)");
  if (found.source_dimensions < found.target_dimensions)
    warnings.push_back("the source varies in " + std::to_string(found.source_dimensions) +
                       (found.source_dimensions == 1 ? " dimension" : " dimensions") +
                       " and the template in " + std::to_string(found.target_dimensions) +
                       ": part of the template's variation is lost (use a source with more variation)");
  for (int k = found.fixed_directions; k < found.dimensions; ++k)
    warnings.push_back("strokes do not determine direction " + std::to_string(k + 1) + " of " +
                       std::to_string(found.dimensions) +
                       ": the result varies there like the source (add a stroke pair that differs from the "
                       "others in another way)");
  if (found.fold_share > 0.005)
    warnings.push_back(
        percent(found.fold_share) +
        " of the source is folded by the warp (check whether neighboring strokes are swapped)");
  if (found.stroke_distance > 0.5)
    warnings.push_back(
        "strokes contradict each other: images of source strokes are " + percent(found.stroke_distance) +
        " of the template's spread away from their partners, most of all " +
        found.strokes[found.worst_stroke] + " (check whether it marks the same region in both)");
  if (found.coverage < 0.5)
    warnings.push_back("only " + percent(found.coverage) +
                       " of the template's appearances are used (add strokes on its other regions)");
  return warnings;
}

}  // namespace remap
