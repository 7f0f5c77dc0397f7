// Features by samples, for every model, table and distance without a closed form.
#pragma once

#include "warp/space/appearance_features.hpp"

namespace remapc {

// Like appearance_features(). `weights`: of direction_weights(); ignored for profiles.
FeaturePair sampled_features(const MaterialRef& source, const MaterialRef& target,
                             AppearanceDistance distance, const Eigen::VectorXd& weights);

// The mean reflectance over kReferenceTexels texels and all channels, at every direction.
Eigen::VectorXd mean_of_samples(const MaterialRef& material);

Eigen::VectorXd features_of_samples(const SampledFeatures& features, const Eigen::VectorXd& samples);

// The samples that the features compare: the reflectance at every direction, or the profile at every radius,
// of red, green and blue.
Eigen::VectorXd samples_of(const SampledFeatures& features, const remap::WarpTexel& texel);
Eigen::VectorXd samples_of(const SampledFeatures& features, const TabulatedMaterial& material,
                           std::uint32_t entry);

}  // namespace remapc
