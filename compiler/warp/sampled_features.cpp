// This file computes features from samples, for every model and table without a closed formula.
#include <algorithm>
#include <numbers>

#include "core/errors.hpp"
#include "renderer/fresnel.hpp"
#include "warp/decompositions.hpp"
#include "warp/features.hpp"

namespace remap {
namespace {

constexpr std::size_t kBasisTexels = 256;  // number of texels from each material
constexpr double kLeastShare = 1e-9;       // relative to the largest eigenvalue; weaker directions are noise
constexpr Eigen::Index kLargestBasis = 64;
constexpr double kLargestF0 = 0.999;

// Returns the radii of both materials in increasing order, without duplicates.
std::vector<double> merged_radii(const TabulatedMaterial& a, const TabulatedMaterial& b) {
  std::vector<double> radii = a.radii;
  radii.insert(radii.end(), b.radii.begin(), b.radii.end());
  std::ranges::sort(radii);
  radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
  return radii;
}

// Returns r dr in equation (5) of An et al. 2011, by the trapezoidal rule.
Eigen::VectorXd radial_measure(const std::vector<double>& radii) {
  Eigen::VectorXd measure(static_cast<Eigen::Index>(radii.size()));
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double before = i == 0 ? 0.0 : radii[i - 1],
                 after = i + 1 == radii.size() ? radii[i] : radii[i + 1];
    measure[static_cast<Eigen::Index>(i)] = radii[i] * 0.5 * (after - before);
  }
  return measure;
}

// Returns one channel of a profile at a radius. The profile is linear between samples, constant before the
// first and 0 after the last.
double profile_at(const std::vector<double>& radii, const float* samples, double radius) {
  const auto above = std::lower_bound(radii.begin(), radii.end(), radius);
  if (above == radii.end()) return 0.0;
  const auto i = static_cast<std::size_t>(above - radii.begin());
  const auto value = [&](std::size_t k) { return static_cast<double>(samples[k]); };
  if (i == 0) return value(0);
  const double share = (radius - radii[i - 1]) / (radii[i] - radii[i - 1]);
  return value(i - 1) + share * (value(i) - value(i - 1));
}

// Makes the features without their basis.
SampledFeatures frame_of(const MaterialRef& source, const MaterialRef& target, AppearanceDistance distance,
                         const Eigen::VectorXd& weights) {
  SampledFeatures frame;
  frame.weights = weights;
  if (!source.is_profiles()) return frame;
  if (distance == AppearanceDistance::kRelative)
    throw usage_error(
        "distance: 'relative' is not defined for scattering profiles (choose plain, as An et al. 2011, "
        "section 4)");
  frame.radii = merged_radii(*source.tabulated(), *target.tabulated());
  frame.weights = radial_measure(frame.radii).cwiseSqrt();
  return frame;
}

// Weights samples so that their Euclidean distance is the appearance distance.
Eigen::VectorXd weighted(const SampledFeatures& features, Eigen::VectorXd samples) {
  const Eigen::Index rows = features.weights.size();
  for (Eigen::Index i = 0; i < samples.size(); ++i) samples[i] *= features.weights[i % rows];
  return samples;
}

// Returns the exact Fresnel reflectance of a dielectric with this F0, or of a mirror if F0 is almost 1.
Eigen::VectorXd dielectric_reflectance(const Eigen::VectorXd& cosines, double f0) {
  const double ior = ior_of_reflectance(std::min(f0, kLargestF0));
  return cosines.unaryExpr([&](double cosine) { return fresnel_dielectric(cosine, ior).mean(); });
}

// Adds the lobes by which parametric texels are sampled.
void add_lobes(const WarpMaterial& material, SampledFeatures* features) {
  const std::vector<QuadratureDirection> directions = half_vector_quadrature();
  features->lobes = lobe_table(material.model, directions);
  if (!material.is_dielectric) return;
  features->cosines.resize(static_cast<Eigen::Index>(directions.size()));
  for (std::size_t i = 0; i < directions.size(); ++i)
    features->cosines[static_cast<Eigen::Index>(i)] = directions[i].geometry.cos_light_half;
}

// Returns an orthonormal basis of the space that some texels of both materials span: the principal directions
// about the origin.
Eigen::MatrixXd basis_of(const SampledFeatures& source, const MaterialRef& source_material,
                         const SampledFeatures& target, const MaterialRef& target_material) {
  const auto from = sample_texels(source_material, kBasisTexels),
             to = sample_texels(target_material, kBasisTexels);
  Eigen::MatrixXd columns(3 * source.weights.size(), static_cast<Eigen::Index>(from.size() + to.size()));
  Eigen::Index next = 0;
  for (const std::uint32_t texel : from)
    columns.col(next++) = weighted(source, samples_of(source, source_material, texel));
  for (const std::uint32_t texel : to)
    columns.col(next++) = weighted(target, samples_of(target, target_material, texel));
  const auto [values, vectors] = symmetric_eigen(columns.transpose() * columns);
  const double least = kLeastShare * values[values.size() - 1];
  const Eigen::Index rank =
      std::clamp<Eigen::Index>((values.array() > least).count(), 1, std::min(kLargestBasis, values.size()));
  const Eigen::VectorXd lengths = values.tail(rank).cwiseMax(1e-300).cwiseSqrt();
  return columns * vectors.rightCols(rank) * lengths.cwiseInverse().asDiagonal();
}

}  // namespace

Eigen::VectorXd samples_of(const SampledFeatures& features, const WarpTexel& texel) {
  const WidthPosition width = width_position(static_cast<double>(texel[6]));
  const Eigen::Index rows = features.weights.size();
  Eigen::VectorXd samples(3 * rows);
  for (Eigen::Index c = 0; c < 3; ++c) {
    const double diffuse = static_cast<double>(texel[static_cast<std::size_t>(c)]) / std::numbers::pi;
    const double specular = static_cast<double>(texel[static_cast<std::size_t>(3 + c)]);
    const auto lobe = [&](Eigen::Index node) -> Eigen::VectorXd {
      if (features.cosines.size() == 0)
        return specular * features.lobes.slope.col(node) + features.lobes.base.col(node);
      return features.lobes.slope.col(node).cwiseProduct(dielectric_reflectance(features.cosines, specular));
    };
    samples.segment(c * rows, rows) =
        ((1.0 - width.fraction) * lobe(width.node) + width.fraction * lobe(width.node + 1)).array() + diffuse;
  }
  return samples;
}

Eigen::VectorXd samples_of(const SampledFeatures& features, const TabulatedMaterial& material,
                           std::uint32_t entry) {
  const auto column = material.samples.col(static_cast<Eigen::Index>(entry));
  if (features.radii.empty()) return column.cast<double>();
  const auto own = static_cast<Eigen::Index>(material.radii.size()), rows = features.weights.size();
  Eigen::VectorXd samples(3 * rows);
  for (Eigen::Index c = 0; c < 3; ++c)
    for (Eigen::Index i = 0; i < rows; ++i)
      samples[c * rows + i] =
          profile_at(material.radii, column.data() + c * own, features.radii[static_cast<std::size_t>(i)]);
  return samples;
}

Eigen::VectorXd samples_of(const SampledFeatures& features, const MaterialRef& material,
                           std::uint32_t texel) {
  if (material.parametric() != nullptr)
    return samples_of(features, clamped(material.parametric()->texels[texel]));
  return samples_of(features, *material.tabulated(), material.tabulated()->entries[texel]);
}

Eigen::VectorXd mean_of_samples(const MaterialRef& material) {
  SampledFeatures features;
  const auto rows = static_cast<Eigen::Index>(half_vector_quadrature().size());
  features.weights = Eigen::VectorXd::Ones(rows);
  if (material.parametric() != nullptr) add_lobes(*material.parametric(), &features);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows);
  const std::vector<std::uint32_t> texels = sample_texels(material, kReferenceTexels);
  for (const std::uint32_t texel : texels) {
    const Eigen::VectorXd samples = samples_of(features, material, texel);
    for (Eigen::Index c = 0; c < 3; ++c) sum += samples.segment(c * rows, rows);
  }
  return sum / (3.0 * static_cast<double>(texels.size()));
}

Eigen::VectorXd features_of_samples(const SampledFeatures& features, const Eigen::VectorXd& samples) {
  return features.basis.transpose() * weighted(features, samples);
}

FeaturePair sampled_features(const MaterialRef& source, const MaterialRef& target,
                             AppearanceDistance distance, const Eigen::VectorXd& weights) {
  const SampledFeatures frame = frame_of(source, target, distance, weights);
  const auto with_lobes = [&](const MaterialRef& material) {
    SampledFeatures features = frame;
    if (material.parametric() != nullptr) add_lobes(*material.parametric(), &features);
    return features;
  };
  SampledFeatures from = with_lobes(source), to = with_lobes(target);
  from.basis = to.basis = basis_of(from, source, to, target);
  return {std::move(from), std::move(to)};
}

}  // namespace remap
