#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"
#include "remap/path.hpp"

namespace remap {
namespace {

// Returns the area of the source's alpha and specular plane that all steps cover.
double covered_area(const ConverterPath& path) {
  const SourceDomain domain = chained_domain(path.steps);
  const RoughnessEncoding convention = path.steps.front()->info().source.roughness;
  const double alphas =
      std::fabs(to_alpha(convention, domain.roughness.max) - to_alpha(convention, domain.roughness.min));
  return alphas * (domain.specular.max - domain.specular.min);
}

bool is_less(const ConverterPath& a, const ConverterPath& b) {
  return rounded_up(a.expected_error, 3) < rounded_up(b.expected_error, 3);
}

}  // namespace

bool is_copy(const ConverterPath& path) {
  return std::all_of(path.steps.begin(), path.steps.end(),
                     [](const Converter* step) { return step->info().is_copy; });
}

bool is_measured(const ConverterPath& path) {
  return std::all_of(path.steps.begin(), path.steps.end(),
                     [](const Converter* step) { return step->info().image_rms_error.has_value(); });
}

const ConverterPath& closest_path(const std::vector<ConverterPath>& paths) {
  std::vector<double> areas;
  for (const ConverterPath& path : paths) areas.push_back(covered_area(path));
  const double least_area = kLeastCoverage * *std::max_element(areas.begin(), areas.end());
  const ConverterPath* closest = nullptr;
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (areas[i] >= least_area && (closest == nullptr || is_less(paths[i], *closest))) closest = &paths[i];
  return *closest;
}

std::optional<ConverterPath> closer_path(const ConverterPath& path,
                                         const std::vector<ConverterPath>& others) {
  const std::string& model = target_model(path);
  const std::string renderer = renderer_of(model);
  if (!is_measured(path) || path.expected_error <= kUnseenError || renderer.empty()) return std::nullopt;
  std::vector<ConverterPath> closer;
  for (const ConverterPath& other : others)
    if (target_model(other) != model && renderer_of(target_model(other)) == renderer &&
        other.expected_error <= kCloserShare * path.expected_error && is_measured(other))
      closer.push_back(other);
  if (closer.empty()) return std::nullopt;
  const double least_area = kLeastCoverage * covered_area(path);
  std::erase_if(closer, [&](const ConverterPath& other) { return covered_area(other) < least_area; });
  if (closer.empty()) return std::nullopt;
  return *std::min_element(closer.begin(), closer.end(), is_less);
}

}  // namespace remap
