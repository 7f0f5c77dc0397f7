#include "study/study_sweep.hpp"

#include <cmath>

#include "text/number_text.hpp"

namespace remapc {

SweepOptions study_sweep_options(const std::string& source, const std::string& target,
                                 std::vector<SamplePoint> samples, int resolution) {
  SweepOptions options;
  options.source = source;
  options.target = target;
  options.objective = {{Light{45.0, 3.0}}, Weighting::kUniform, 0.1};
  options.objective_name = "custom";
  options.resolution = resolution;
  options.sampling = std::to_string(samples.size()) + " of a study";
  options.samples = std::move(samples);
  return options;
}

std::string short_text(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return remap::number_text(value);
  const double unit = std::pow(10.0, digits - 1 - static_cast<int>(std::floor(std::log10(std::fabs(value)))));
  return remap::number_text(unit >= 1.0 ? std::round(value * unit) / unit
                                        : std::round(value * unit) * (1.0 / unit));
}

std::string percent_text(double share) { return short_text(100.0 * share) + " %"; }

}  // namespace remapc
