#include "sweep/spheres.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "renderer/image_similarity.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

// Returns, for each width, the usable row whose specular is nearest `specular`.
std::map<double, const TableRow*> middle_rows(const std::vector<TableRow>& rows, double specular) {
  std::map<double, const TableRow*> middle;
  for (const TableRow& row : rows) {
    if (row.status != RowStatus::kOk) continue;
    const TableRow*& chosen = middle[row.alpha1];
    if (chosen == nullptr || std::fabs(row.specular1 - specular) < std::fabs(chosen->specular1 - specular))
      chosen = &row;
  }
  return middle;
}

std::vector<const TableRow*> compared_rows(const SweepSetup& setup, const std::vector<TableRow>& rows) {
  const remap::Range range = setup.source.linear_range();
  std::vector<const TableRow*> all, spread;
  for (const auto& [alpha, row] : middle_rows(rows, 0.5 * (range.min + range.max))) all.push_back(row);
  const std::size_t count = std::min(all.size(), kComparedSpheres);
  for (std::size_t i = 0; i < count; ++i)
    spread.push_back(all[count == 1 ? 0 : i * (all.size() - 1) / (count - 1)]);
  return spread;
}

// Returns the exposure at which the brightest point of a white diffuse sphere is 1. Without diffuse it is
// computed for an albedo of 1, lit at right angles from the distance of the light.
double white_exposure(const SweepSetup& setup) {
  if (!setup.target.model.has(ParameterRole::kDiffuse)) {
    const double distance = setup.options.objective.lights.front().distance - 1.0;
    return std::numbers::pi * distance * distance;
  }
  const double alpha = std::sqrt(setup.target.model.alpha.min * setup.target.model.alpha.max);
  const double black = setup.target.specular_range().min;
  const double white = setup.target.model.parameter(ParameterRole::kDiffuse).range.max;
  const auto lit = setup.picture_taker.take(setup.target, {alpha, black, white});
  const auto dark = setup.picture_taker.take(setup.target, {alpha, black, 0.0});
  float brightest = 0.0f;
  for (std::size_t i = 0; i < setup.picture_taker.pixel_count(); ++i)
    brightest = std::max(brightest, lit[i] - dark[i]);
  return brightest > 0.0f ? 1.0 / static_cast<double>(brightest) : 1.0;
}

}  // namespace

std::vector<remap::SphereSimilarity> compare_spheres(const SweepSetup& setup,
                                                     const std::vector<TableRow>& rows) {
  const double exposure = white_exposure(setup);
  const int side = setup.options.resolution;
  const auto displayed = [&](const ProbedModel& probed_model, double alpha, double specular) {
    std::vector<float> square =
        setup.picture_taker.square_picture(setup.picture_taker.take(probed_model, {alpha, specular, 0.0}));
    for (float& value : square) value = display_value(exposure * static_cast<double>(value));
    return square;
  };
  std::vector<remap::SphereSimilarity> spheres;
  for (const TableRow* row : compared_rows(setup, rows)) {
    const auto source = displayed(setup.source, row->alpha1, row->specular1);
    const auto target = displayed(setup.target, row->alpha2, row->specular2);
    const double ssim = structural_similarity(source, target, side, side);
    spheres.push_back({row->alpha1, std::round(ssim * 1e4) / 1e4});
  }
  return spheres;
}

std::string spheres_text(const std::vector<remap::SphereSimilarity>& spheres) {
  std::string text;
  for (const auto& [alpha, ssim] : spheres)
    text += (text.empty() ? "" : ", ") + remap::number_text(alpha) + " " + remap::number_text(ssim);
  return text;
}

}  // namespace remapc
