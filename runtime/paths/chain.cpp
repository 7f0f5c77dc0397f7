#include <algorithm>
#include <utility>

#include "remap/error.hpp"
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
    throw Error(ErrorKind::kInput, before.id + " then " + after.id + ": the first converts to " +
                                       side_text(before.target) + ", but the second converts from " +
                                       side_text(after.source));
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

}  // namespace remap
