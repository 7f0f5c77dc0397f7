#include "warp/material.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace remap {
namespace {

void require_strokes(const MaterialRef& material, const std::vector<StrokePair>& strokes,
                     std::vector<std::uint32_t> StrokePair::*side) {
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    const std::string context = material.name() + ", " + stroke_name(strokes, k);
    bool has_finite = false;
    for (const std::uint32_t texel : strokes[k].*side) {
      if (texel >= material.texel_count())
        throw input_error(context + ": texel " + std::to_string(texel) + " is out of range (" +
                          std::to_string(material.texel_count()) + " texels)");
      has_finite = has_finite || material.takes_part(texel);
    }
    if (!has_finite) throw input_error(context + ": the stroke marks no texel with finite values");
  }
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    const Overlap overlap = largest_overlap(strokes, side, k, material.texel_count());
    if (overlap.share == 1.0)
      throw input_error(material.name() + ", " + stroke_name(strokes, k) + ": lies within " +
                        stroke_name(strokes, overlap.other) + " (erase one of the two strokes there)");
  }
}

}  // namespace

std::string stroke_name(const std::vector<StrokePair>& strokes, std::size_t stroke) {
  const std::string& color = strokes[stroke].color;
  return "stroke " + (color.empty() ? std::to_string(stroke + 1) : color);
}

Overlap largest_overlap(const std::vector<StrokePair>& strokes, std::vector<std::uint32_t> StrokePair::*side,
                        std::size_t stroke, std::size_t texel_count) {
  std::vector<char> own(texel_count, 0);
  double size = 0.0;
  for (const std::uint32_t texel : strokes[stroke].*side) {
    size += own[texel] == 0 ? 1.0 : 0.0;
    own[texel] = 1;
  }
  Overlap largest;
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    if (k == stroke) continue;
    std::vector<char> shared = own;
    double count = 0.0;
    for (const std::uint32_t texel : strokes[k].*side) {
      count += shared[texel] != 0 ? 1.0 : 0.0;
      shared[texel] = 0;
    }
    if (count / size > largest.share) largest = {stroke, k, count / size, side == &StrokePair::target};
  }
  return largest;
}

WarpTexel clamped(const WarpTexel& texel) noexcept {
  WarpTexel result = texel;
  for (float& value : result) value = value < 0.0f ? 0.0f : value > 1.0f ? 1.0f : value;
  return result;
}

bool MaterialRef::takes_part(std::size_t texel) const noexcept {
  if (parametric_ != nullptr)
    return std::ranges::all_of(parametric_->texels[texel], [](float value) { return std::isfinite(value); });
  return static_cast<Eigen::Index>(tabulated_->entries[texel]) < tabulated_->samples.cols();
}

std::vector<std::uint32_t> sample_texels(const MaterialRef& material, std::size_t limit) {
  std::vector<std::uint32_t> texels;
  const std::size_t count = material.texel_count(), wanted = std::min(limit, count);
  const std::size_t step = count / std::max<std::size_t>(wanted, 1);
  texels.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i)
    if (const std::size_t texel = i * count / wanted + i * 61 % step; material.takes_part(texel))
      texels.push_back(static_cast<std::uint32_t>(texel));
  if (!texels.empty()) return texels;
  // None of these texels is used, so take the first texels that are.
  for (std::size_t i = 0; i < count && texels.size() < limit; ++i)
    if (material.takes_part(i)) texels.push_back(static_cast<std::uint32_t>(i));
  return texels;
}

void require_valid(const MaterialRef& source, const MaterialRef& target,
                   const std::vector<StrokePair>& strokes) {
  for (const MaterialRef* material : {&source, &target}) {
    const TabulatedMaterial* table = material->tabulated();
    if (table != nullptr && !(table->samples.array() >= 0.0f && table->samples.array().isFinite()).all())
      throw input_error(material->name() + ": contains samples that are negative or not finite");
    if (sample_texels(*material, 1).empty())
      throw input_error(material->name() + ": contains no texel with finite values");
  }
  if (strokes.empty()) throw usage_error(source.name() + ": at least one pair of strokes is required");
  require_strokes(source, strokes, &StrokePair::source);
  require_strokes(target, strokes, &StrokePair::target);
}

}  // namespace remap
