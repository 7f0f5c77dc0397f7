// Features by samples: the way of every model, table and distance that has no closed form.
#pragma once

#include "warp/space/appearance_features.hpp"

namespace remapc {

// As appearance_features(). `weights`: those of direction_weights(); not looked at where both are profiles.
FeaturePair sampled_features(const MaterialRef& source, const MaterialRef& target,
                             AppearanceDistance distance, const Eigen::VectorXd& weights);

// The mean reflectance over 400 texels and all channels, at every direction.
Eigen::VectorXd mean_of_samples(const MaterialRef& material);

Eigen::VectorXd features_of_samples(const SampledFeatures& features, const Eigen::VectorXd& samples);

// What the features compare: reflectance at every direction, or a profile at every radius, of red, green and
// blue.
Eigen::VectorXd samples_of(const SampledFeatures& features, const remap::WarpTexel& texel);
Eigen::VectorXd samples_of(const SampledFeatures& features, const TabulatedMaterial& material,
                           std::uint32_t entry);

}  // namespace remapc
