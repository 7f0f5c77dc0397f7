#include "warp/warp.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "error.hpp"
#include "named_values.hpp"
#include "report_text.hpp"
#include "warp/warp_table.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

constexpr remap::NamedValues<WarpMethod, 4> kMethods = {{{WarpMethod::kRegistration, "registration"},
                                                         {WarpMethod::kAffine, "affine"},
                                                         {WarpMethod::kHistogram, "histogram"},
                                                         {WarpMethod::kPaper, "paper"}}};

constexpr std::size_t kMostTexels = std::size_t{1} << 18;

using StrokeTexels = std::vector<std::vector<std::uint32_t>>;

// A material without what takes no part, and strokes as indices into it.
struct Sampled {
  WarpMaterial material;
  StrokeTexels strokes;
  std::size_t left_out = 0;
};

Sampled sampled(const WarpMaterial& given, const std::vector<StrokePair>& strokes,
                std::vector<std::uint32_t> StrokePair::*side) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  const std::size_t count = given.texels.size();
  std::vector<char> wanted(count, 0);
  const std::size_t step = (count + kMostTexels - 1) / kMostTexels;
  for (std::size_t i = 0, block = 0; i < count; i += step, ++block)
    wanted[std::min(i + block * 61 % step, count - 1)] = 1;  // scattered, so that samples stand in no columns
  for (const StrokePair& stroke : strokes)
    for (const std::uint32_t texel : stroke.*side) wanted[texel] = 1;

  Sampled result{{given.name, given.model, {}}, {}, 0};
  std::vector<std::uint32_t> index(count, kNone);
  for (std::size_t i = 0; i < count; ++i) {
    const bool finite = is_finite(given.texels[i]);
    if (!finite) ++result.left_out;
    if (!finite || wanted[i] == 0) continue;
    index[i] = static_cast<std::uint32_t>(result.material.texels.size());
    result.material.texels.push_back(held(given.texels[i]));
  }
  for (const StrokePair& stroke : strokes) {
    std::vector<std::uint32_t>& own = result.strokes.emplace_back();
    for (const std::uint32_t texel : stroke.*side)
      if (index[texel] != kNone) own.push_back(index[texel]);
  }
  return result;
}

AppearanceWarp warp_by(WarpMethod method, const PointSets& sets) {
  switch (method) {
    case WarpMethod::kAffine:
      return affine_from_strokes(sets);
    case WarpMethod::kHistogram:
      return warp_by_histograms(sets);
    case WarpMethod::kPaper:
      return warp_of_paper(sets);
    case WarpMethod::kRegistration:
      break;
  }
  return register_points(sets, affine_from_strokes(sets));
}

// Directions along which the centres of the strokes differ by more than a tenth of the radius.
int fixed_directions(const Points& centres) {
  const Points centred = centres.rowwise() - centres.colwise().mean();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred);
  return static_cast<int>(
      (svd.singularValues().array() > 0.1 * std::sqrt(static_cast<double>(centres.rows()))).count());
}

double rms_distance(const Points& a, const Points& b, std::size_t* worst = nullptr) {
  const Eigen::VectorXd squares = (a - b).rowwise().squaredNorm();
  Eigen::Index farthest = 0;
  squares.maxCoeff(&farthest);
  if (worst != nullptr) *worst = static_cast<std::size_t>(farthest);
  return std::sqrt(squares.mean());
}

// Over the points of the source: the share of template points that one of them reaches, each as far as a bin.
double coverage_of(const AppearanceWarp& warp, const PointSets& sets) {
  const Points images = images_of(warp, sets.source.points);
  const Points& goal = sets.target.points;
  std::vector<char> used(static_cast<std::size_t>(goal.rows()), 0);
  for (Eigen::Index j = 0; j < goal.rows(); ++j) {
    const double distance = (images.rowwise() - goal.row(j)).rowwise().squaredNorm().minCoeff();
    used[static_cast<std::size_t>(j)] = distance < sets.target.spacing * sets.target.spacing ? 1 : 0;
  }
  return static_cast<double>(std::count(used.begin(), used.end(), 1)) / static_cast<double>(used.size());
}

WarpDiagnostics::SharedStroke most_shared(const WarpMaterial& source, const WarpMaterial& target,
                                          const std::vector<StrokePair>& strokes) {
  WarpDiagnostics::SharedStroke most;
  for (std::size_t k = 0; k < strokes.size(); ++k)
    for (const bool in_template : {false, true}) {
      const Overlap overlap = in_template
                                  ? largest_overlap(strokes, &StrokePair::target, k, target.texels.size())
                                  : largest_overlap(strokes, &StrokePair::source, k, source.texels.size());
      if (overlap.share > most.overlap.share) most = {k, overlap, in_template};
    }
  return most;
}

void require_options(const WarpOptions& options) {
  if (options.dimensions < 0 || options.dimensions > static_cast<int>(remap::kLargestWarpDimension))
    throw Error(ErrorKind::kUsage, "dimensions: " + std::to_string(options.dimensions) +
                                       "; expected 1 to 3, or 0 for those that are needed");
  if (options.nodes == 1 || options.nodes > 1024)
    throw Error(ErrorKind::kUsage, "nodes: " + std::to_string(options.nodes) + "; expected 2 to 1024");
}

}  // namespace

std::string_view method_name(WarpMethod method) { return remap::name_of(kMethods, method); }
std::optional<WarpMethod> method_from_name(std::string_view name) {
  return remap::value_named(kMethods, name);
}
std::vector<std::string> method_names() { return remap::names_of(kMethods); }

WarpFit fit_warp(const WarpMaterial& source, const WarpMaterial& target,
                 const std::vector<StrokePair>& strokes, const WarpOptions& options) {
  require_options(options);
  require_valid(source, target, strokes);
  const Sampled from = sampled(source, strokes, &StrokePair::source);
  const Sampled to = sampled(target, strokes, &StrokePair::target);
  const FeaturePair features = appearance_features(from.material, to.material, options.distance);
  const AppearanceSpace from_space = appearance_space(from.material, features.source);
  const AppearanceSpace to_space = appearance_space(to.material, features.target);

  WarpFit fit;
  WarpDiagnostics& found = fit.diagnostics;
  found.shared = most_shared(source, target, strokes);
  found.source_left_out = from.left_out;
  found.target_left_out = to.left_out;
  found.source_dimensions = dimension_of(from_space);
  found.target_dimensions = dimension_of(to_space);
  found.dimensions = options.dimensions != 0 ? options.dimensions
                                             : std::max(found.source_dimensions, found.target_dimensions);
  const auto last = static_cast<std::size_t>(found.dimensions) - 1;
  found.source_stress = from_space.stress[last];
  found.target_stress = to_space.stress[last];

  fit.compiled.coordinates = closed_form(from_space, features.source, found.dimensions);
  fit.target_coordinates = closed_form(to_space, features.target, found.dimensions);
  fit.target_radius = to_space.radius;
  const Points from_positions = positions_of(fit.compiled.coordinates, from.material.texels);
  const Points to_positions = positions_of(fit.target_coordinates, to.material.texels);
  const PointSets sets = {occupancy_of(from_positions, from.strokes), occupancy_of(to_positions, to.strokes),
                          common_axes(from_space, to_space, found.dimensions),
                          stroke_centres(from_positions, from.strokes),
                          stroke_centres(to_positions, to.strokes)};
  fit.warp = warp_by(options.method, sets);

  found.fixed_directions = fixed_directions(sets.source_centres);
  found.fold_share = fold_share(fit.warp, sets.source.points, sets.source.texel_count);
  found.coverage = coverage_of(fit.warp, sets);
  found.stroke_distance =
      rms_distance(images_of(fit.warp, sets.source_centres), sets.target_centres, &found.worst_stroke);
  found.stroke_contradiction =
      rms_distance(images_of(affine_from_strokes(sets), sets.source_centres), sets.target_centres);
  const std::size_t nodes =
      options.nodes != 0 ? options.nodes : default_nodes(found.dimensions, options.exact);
  fit.compiled.table =
      compile_table(fit.warp, from_positions, NearestTexel(to_positions), to.material, nodes, options.exact);
  return fit;
}

std::vector<std::uint32_t> copy_exactly(const WarpFit& fit, const WarpMaterial& source,
                                        const WarpMaterial& target) {
  const NearestTexel nearest(positions_of(fit.target_coordinates, target.texels));
  Points images = images_of(fit.warp, positions_of(fit.compiled.coordinates, source.texels));
  for (Eigen::Index i = 0; i < images.rows(); ++i)
    if (!images.row(i).allFinite()) images.row(i).setZero();
  std::vector<std::uint32_t> texels = nearest.find(images);
  for (std::size_t i = 0; i < texels.size(); ++i)
    if (!is_finite(source.texels[i])) texels[i] = 0;
  return texels;
}

std::vector<std::string> warnings_of(const WarpDiagnostics& found) {
  std::vector<std::string> warnings;
  if (found.source_left_out > 0 || found.target_left_out > 0)
    warnings.push_back(std::to_string(found.source_left_out) + " texels of the source and " +
                       std::to_string(found.target_left_out) +
                       " of the template are not finite and take no part");
  if (found.shared.overlap.share > 0.5)
    warnings.push_back("stroke " + std::to_string(found.shared.overlap.other + 1) + " covers " +
                       percent(found.shared.overlap.share) + " of stroke " +
                       std::to_string(found.shared.stroke + 1) + " in the " +
                       (found.shared.in_template ? "template" : "source") +
                       ": the two mean one region there; erase one of them");
  if (found.source_dimensions < found.target_dimensions)
    warnings.push_back(
        "the source varies in " + std::to_string(found.source_dimensions) + " ways and the template in " +
        std::to_string(found.target_dimensions) +
        ": what the source does not tell apart is lost; a source with more variation keeps it");
  for (int k = found.fixed_directions; k < found.dimensions; ++k)
    warnings.push_back(
        "strokes do not fix direction " + std::to_string(k + 1) + " of " + std::to_string(found.dimensions) +
        ": the result brightens there as the source does; a stroke pair that differs from the others "
        "in another way fixes it");
  if (found.fold_share > 0.005)
    warnings.push_back(percent(found.fold_share) +
                       " of the source is turned inside out: neighbouring strokes may be exchanged");
  if (found.stroke_distance > 0.5)
    warnings.push_back(
        "strokes contradict each other: images of source strokes are " + percent(found.stroke_distance) +
        " of the template's spread from their partners, stroke " + std::to_string(found.worst_stroke + 1) +
        " the most; look whether it marks the same region twice");
  if (found.coverage < 0.5)
    warnings.push_back("only " + percent(found.coverage) +
                       " of the template's appearances are used; strokes on its other regions bring them in");
  return warnings;
}

}  // namespace remapc
