#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "remap/path.hpp"

namespace remap {
namespace {

void require_joined(const std::vector<const Converter*>& steps) {
  const auto side_text = [](const ModelSide& side) {
    return std::string(encoding_name(side.roughness)) + " and " + side.specular + " of " + side.model;
  };
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const ConverterInfo &before = steps[i]->info(), &after = steps[i + 1]->info();
    if (before.target == after.source) continue;
    throw input_error(before.id + " then " + after.id + ": the first converts to " +
                      side_text(before.target) + ", but the second converts from " + side_text(after.source));
  }
}

// Adds an error. The sum is unknown if any error is unknown.
void add(const std::optional<double>& error, std::optional<double>* sum) {
  if (*sum && error)
    **sum += *error;
  else
    sum->reset();
}

ConverterInfo chained_info(const std::vector<const Converter*>& steps) {
  require_joined(steps);
  ConverterInfo info = steps.front()->info();
  info.target = steps.back()->info().target;
  info.id = converter_id(info.source.model, info.target.model);
  const SourceDomain domain = chained_domain(steps);
  info.roughness = domain.roughness;
  info.specular = domain.specular;
  info.roughness_rms_error = info.specular_rms_error = 0.0;
  info.image_rms_error = 0.0;
  info.ssim = 1.0;
  info.pictures = std::nullopt;
  for (const Converter* step : steps) {
    const ConverterInfo& other = step->info();
    add(other.roughness_rms_error, &info.roughness_rms_error);
    add(other.specular_rms_error, &info.specular_rms_error);
    add(other.image_rms_error, &info.image_rms_error);
    info.is_copy = info.is_copy && other.is_copy;
    info.ssim = info.ssim && other.ssim ? std::optional(std::min(*info.ssim, *other.ssim)) : std::nullopt;
    info.instructions = std::min(info.instructions, other.instructions);
    info.steps.push_back(other.id);
  }
  return info;
}

}  // namespace

std::unique_ptr<Converter> make_chained_converter(const std::vector<const Converter*>& steps) {
  StageList stages;
  for (const Converter* step : steps)
    stages.insert(stages.end(), step->stages().begin(), step->stages().end());
  return std::make_unique<Converter>(chained_info(steps), std::move(stages));
}

namespace {

using Steps = std::span<const Converter* const>;

constexpr std::size_t kWidths = 33;
constexpr std::size_t kSpeculars = 9;

float float_of(double value) { return static_cast<float>(value); }

// Returns `count` values from one end to the other, including both ends.
std::vector<float> spread(const Range& range, std::size_t count) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    values[i] = float_of(range.min + share * (range.max - range.min));
  }
  values.back() = float_of(range.max);
  return values;
}

bool all_within(const std::vector<float>& values, const Range& range) {
  const float low = float_of(range.min), high = float_of(range.max);
  return std::ranges::all_of(values, [&](float v) { return v >= low && v <= high; });
}

enum class Look { kRoughness, kBoth };

// Returns true if the first step maps grey texels into the domains of the later steps. The texels are all
// pairs of the given widths and speculars.
bool images_fit(Steps steps, std::vector<float> width, std::vector<float> specular, Look look) {
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    const std::array<const float*, 1> in = {specular.data()};
    const std::array<float*, 1> out = {specular.data()};
    steps[k]->convert(width.size(), width.data(), in, width.data(), out);
    const ConverterInfo& next = steps[k + 1]->info();
    if (!all_within(width, next.roughness)) return false;
    if (look == Look::kBoth && !all_within(specular, next.specular)) return false;
  }
  return true;
}

// Returns the value between `good` and `bad` that is furthest from `good` and for which `holds` is true. It
// must be true for `good`.
template <typename Predicate>
float furthest(float good, float bad, const Predicate& holds) {
  if (holds(bad)) return bad;
  for (;;) {
    const float middle = good + 0.5f * (bad - good);
    if (middle == good || middle == bad) return good;
    (holds(middle) ? good : bad) = middle;
  }
}

// Rounds `value` to 4 significant digits, downwards or upwards. If it equals `end` or 0, returns `end`
// unchanged.
double shortened(float value, double end, bool upwards) {
  if (value == float_of(end) || value == 0.0f) return end;
  const double exact = static_cast<double>(value);
  const double scale = std::pow(10.0, 3.0 - std::floor(std::log10(std::fabs(exact))));
  return (upwards ? std::ceil(exact * scale) : std::floor(exact * scale)) / scale;
}

}  // namespace

SourceDomain chained_domain(Steps steps) {
  const ConverterInfo& first = steps.front()->info();
  const SourceDomain whole = {first.roughness, first.specular};
  const auto width_fits = [&](float width) {
    return images_fit(steps, std::vector<float>(kSpeculars, width), spread(whole.specular, kSpeculars),
                      Look::kRoughness);
  };
  const RoughnessEncoding convention = first.source.roughness;
  const double middle_alpha =
      0.5 * (to_alpha(convention, whole.roughness.min) + to_alpha(convention, whole.roughness.max));
  const float middle = float_of(from_alpha(convention, middle_alpha));
  if (!width_fits(middle)) return whole;
  SourceDomain part;
  part.roughness.min =
      shortened(furthest(middle, float_of(whole.roughness.min), width_fits), whole.roughness.min, true);
  part.roughness.max =
      shortened(furthest(middle, float_of(whole.roughness.max), width_fits), whole.roughness.max, false);
  const auto specular_fits = [&](float specular) {
    return images_fit(steps, spread(part.roughness, kWidths), std::vector<float>(kWidths, specular),
                      Look::kBoth);
  };
  const float darkest = float_of(whole.specular.min);
  if (!specular_fits(darkest)) return whole;
  part.specular.min = whole.specular.min;
  part.specular.max =
      shortened(furthest(darkest, float_of(whole.specular.max), specular_fits), whole.specular.max, false);
  if (!(part.roughness.min < part.roughness.max && part.specular.min < part.specular.max)) return whole;
  for (const float width : spread(part.roughness, kWidths))
    if (!images_fit(steps, std::vector<float>(kSpeculars, width), spread(part.specular, kSpeculars),
                    Look::kBoth))
      return whole;
  return part;
}

}  // namespace remap
