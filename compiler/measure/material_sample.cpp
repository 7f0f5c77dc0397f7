#include <algorithm>
#include <array>
#include <mutex>
#include <random>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "measure/match.hpp"
#include "measure/sweep.hpp"
#include "measure/sweep_options.hpp"
#include "remap/error.hpp"
#include "remap/version.hpp"
#include "table/regression.hpp"
#include "table/table.hpp"

namespace remap {
namespace {

constexpr int kRandomDigits = 9, kMatchDigits = 9, kMatchErrorDigits = 6;
constexpr std::array kChannelSuffixes = {"_r", "_g", "_b"};

std::vector<std::string> columns_of(const std::string& name, bool color, char side) {
  if (!color) return {name + side};
  std::vector<std::string> columns;
  for (const char* suffix : kChannelSuffixes) columns.push_back(name + suffix + side);
  return columns;
}

// Returns the whole range of a parameter, or the part of it that the options name.
Range range_of(const MaterialSampleOptions& options, const ModelDescription& model,
               const ParameterDescription& parameter) {
  const Range whole = parameter.range;
  if (const auto given = options.ranges.find(parameter.name); given != options.ranges.end()) {
    if (whole.contains(given->second.min) && whole.contains(given->second.max)) return given->second;
    throw usage_error(model.name + ": " + parameter.name + ": the range " + range_text(given->second) +
                      " is not within " + range_text(whole));
  }
  if (parameter.role != ParameterRole::kRoughness) return whole;
  const double narrow =
      from_alpha(model.roughness, std::clamp(kLeastRandomAlpha, model.alpha.min, model.alpha.max));
  const double wide = from_alpha(model.roughness, model.alpha.max);
  return {std::max(whole.min, std::min(narrow, wide)), std::min(whole.max, std::max(narrow, wide))};
}

// Throws for the name of an unknown parameter, or of a parameter that has a role.
void require_roleless(const ModelDescription& model, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (const ParameterRole role = model.parameter(name).role; role != ParameterRole::kOther)
      throw usage_error(model.name + ": " + name + " is the " + std::string(role_word(role)) +
                        " and varies anyway (choose a parameter without a role)");
}

// Returns the source parameters that vary, each with the range in which it varies. If it is grey, it gets one
// value.
std::vector<ParameterDescription> varied_of(const MaterialSampleOptions& options,
                                            const ModelDescription& source) {
  require_roleless(source, options.varied);
  std::vector<ParameterDescription> all;
  for (ParameterDescription parameter : source.parameters) {
    const bool named = std::ranges::find(options.varied, parameter.name) != options.varied.end();
    if (parameter.role == ParameterRole::kOther && !named) continue;
    parameter.range = range_of(options, source, parameter);
    parameter.grey = options.grey || parameter.grey || parameter.role == ParameterRole::kRoughness;
    all.push_back(std::move(parameter));
  }
  for (const auto& given : options.ranges)
    if (std::ranges::none_of(all,
                             [&](const ParameterDescription& varied) { return varied.name == given.first; }))
      throw usage_error(source.name + ": " + given.first + " has a range but does not vary (add --vary " +
                        given.first + ")");
  return all;
}

// Draws the source columns of all samples. It does not use std::uniform_real_distribution, which differs
// between standard libraries.
std::vector<std::vector<double>> draw(const MaterialSampleOptions& options,
                                      const std::vector<ParameterDescription>& varied) {
  std::mt19937_64 generator(options.seed);
  std::vector<std::vector<double>> samples(options.count);
  for (std::vector<double>& sample : samples)
    for (const ParameterDescription& parameter : varied)
      for (int c = 0; c < (parameter.grey ? 1 : 3); ++c) {
        const double share = static_cast<double>(generator() >> 11) * 0x1p-53;
        const Range& range = parameter.range;
        sample.push_back(rounded(range.min + share * (range.max - range.min), kRandomDigits));
      }
  return samples;
}

// A Matching holds the data that the samples share.
struct Matching {
  const MaterialSampleOptions& options;
  const PictureTaker& picture_taker;
  ModelDescription source;
  std::vector<ParameterDescription> varied;
  MatchTarget target;
  LightMatch light;

  bool color(const Coordinate& coordinate) const { return !options.grey && !coordinate.shared; }
};

Material material_of(const Matching& matching, const std::vector<double>& sample) {
  Material material{matching.source.name, {}};
  for (const ParameterDescription& parameter : matching.source.parameters)
    if (parameter.role == ParameterRole::kOther) material.parameters[parameter.name] = {parameter.standard};
  auto value = sample.begin();
  for (const ParameterDescription& varied : matching.varied) {
    const std::ptrdiff_t count = varied.grey ? 1 : 3;
    material.parameters[varied.name].assign(value, value + count);
    value += count;
  }
  return material;
}

double source_alpha(const Matching& matching, const Material& material) {
  const std::string& name = matching.source.parameter(ParameterRole::kRoughness).name;
  return to_alpha(matching.source.roughness, material.parameters.at(name).front());
}

// Return the target's own name of a coordinate, and the target's own value for a canonical value.
std::string target_name(const Matching& matching, std::size_t coordinate) {
  const ModelDescription& model = matching.target.model;
  if (coordinate == kAlphaCoordinate) return model.parameter(ParameterRole::kRoughness).name;
  if (coordinate == kSpecularCoordinate) return model.parameter(ParameterRole::kSpecular).name;
  if (coordinate == kDiffuseCoordinate)
    return model.has(ParameterRole::kDiffuse) ? model.parameter(ParameterRole::kDiffuse).name : "";
  return matching.target.pictures->coordinates()[coordinate].name;
}

double target_value(const Matching& matching, std::size_t coordinate, double canonical) {
  if (coordinate == kAlphaCoordinate) return from_alpha(matching.target.model.roughness, canonical);
  if (coordinate == kSpecularCoordinate) return matching.target.response.native(canonical);
  return canonical;
}

std::vector<double> target_values(const Matching& matching, const std::vector<RoleValues>& points) {
  std::vector<double> values;
  const auto& coordinates = matching.target.pictures->coordinates();
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (target_name(matching, i).empty()) continue;
    for (std::size_t c = 0; c < (matching.color(coordinates[i]) ? 3u : 1u); ++c) {
      const double canonical = matching.target.pictures->value(points[std::min(c, points.size() - 1)], i);
      values.push_back(rounded(target_value(matching, i, canonical), kMatchDigits));
    }
  }
  return values;
}

NamedRow matched_row(const Matching& matching, const std::vector<double>& sample) {
  const Material material = material_of(matching, sample);
  std::vector<JointChannel> channels;
  for (std::vector<float>& picture : matching.picture_taker.take_channels(material)) {
    for (float& value : picture) value = static_cast<float>(value * matching.light.scale);
    auto weights = matching.picture_taker.weights(picture);
    channels.push_back({std::move(picture), std::move(weights)});
  }
  const std::size_t channel_count = channels.size();
  const bool is_black = std::ranges::all_of(channels, &JointChannel::is_black);
  const JointMatcher matcher(*matching.target.pictures, std::move(channels), DiffuseSearch::kFree);
  if (is_black) {
    const RoleValues least = matcher.point_of({0.0, 0.0, 0.0});
    return {sample, target_values(matching, std::vector<RoleValues>(channel_count, least)), 0.0,
            RowStatus::kFlat, 0};
  }
  std::vector<RoleValues> guesses = {matcher.point_of(kFixedGuess)};
  guesses.front().alpha = source_alpha(matching, material);
  const std::vector<RoleValues> others = matcher.other_guesses();
  guesses.insert(guesses.end(), others.begin(), others.end());
  const Match match = matcher.match(guesses);
  return {sample, target_values(matching, match.points), rounded(match.picture_error, kMatchErrorDigits),
          match.status, 0};
}

Matching make_matching(const MaterialSampleOptions& options, const PictureTaker& picture_taker,
                       const ModelDescription& source, const ModelDescription& target) {
  std::vector<ParameterDescription> varied =
      // This may throw, so it is computed before the aggregate below (make_setup() in sweep.cpp has the
      // reason).
      varied_of(options, source);
  Matching matching{options, picture_taker, source, std::move(varied), {}, {}};
  require_roleless(target, options.searched);
  const Range own = range_of(options, source, source.parameter(ParameterRole::kRoughness));
  const double narrowest = std::max({target.alpha.min, canonical_widths(source.roughness, own).min, 1e-4});
  const Range probed{narrowest, target.alpha.max};
  const SpecularResponse law = probe_specular(picture_taker, target, probed);
  if (options.match_irradiance && light_matched(source, target)) {
    const DiffuseMatch diffuse = match_diffuse(picture_taker, source, target);
    matching.light = {1.0 / diffuse.scale, diffuse.error, options.accept_light};
    require_light(matching.light, options.source + " to " + options.target);
  }
  matching.target = match_target(picture_taker, {target, law}, searched_widths(target, narrowest), probed,
                                 true, options.searched);
  return matching;
}

std::string ranges_text(const std::vector<ParameterDescription>& varied) {
  std::string text;
  for (const ParameterDescription& parameter : varied)
    text += (text.empty() ? "" : ", ") + parameter.name + " " + range_text(parameter.range);
  return text;
}

MaterialTable empty_table(const SteadyRenderer& renderer, const Matching& matching) {
  const MaterialSampleOptions& options = matching.options;
  MaterialTable table;
  auto& comments = table.comments;
  comments = {{"tool", std::string("remapc ") + kVersion},
              {"source", matching.source.name},
              {"source_roughness", std::string(encoding_name(matching.source.roughness))}};
  ProbedModel target = matching.target;  // without matched parameters; the remaining ones are fixed
  std::erase_if(target.model.parameters, [&](const ParameterDescription& parameter) {
    return std::ranges::find(options.searched, parameter.name) != options.searched.end();
  });
  add_noise("source", renderer, options.source, &comments);
  add_side("target", target, &comments);
  add_noise("target", renderer, options.target, &comments);
  add_comparison(renderer, options, &comments);
  add_light_scale(matching.light, &comments);
  if (matching.light.diffuse_error > kSaidLightChange)
    comments.emplace_back(kDiffuseErrorComment, number_text(rounded_up(matching.light.diffuse_error, 2)));
  add_resolution(options, &comments);
  comments.emplace_back(
      "samples", std::to_string(options.count) + " random, uniform in " + ranges_text(matching.varied));
  comments.emplace_back("seed", std::to_string(options.seed));
  ModelDescription source = matching.source;  // without varying parameters
  std::erase_if(source.parameters, [&](const ParameterDescription& parameter) {
    return std::ranges::any_of(matching.varied,
                               [&](const ParameterDescription& v) { return v.name == parameter.name; });
  });
  if (const std::string fixed = fixed_text(source); !fixed.empty())
    comments.emplace_back("source_fixed", fixed);
  const auto add = [](std::vector<std::string>* all, const std::vector<std::string>& more) {
    all->insert(all->end(), more.begin(), more.end());
  };
  for (const ParameterDescription& varied : matching.varied)
    add(&table.source_columns, columns_of(varied.name, !varied.grey, '1'));
  const auto& coordinates = matching.target.pictures->coordinates();
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    if (const std::string name = target_name(matching, i); !name.empty())
      add(&table.target_columns, columns_of(name, matching.color(coordinates[i]), '2'));
  return table;
}

}  // namespace

MaterialTable run_material_sample(const Renderer& any_renderer, const MaterialSampleOptions& options,
                                  const SweepExecution& execution) {
  const SteadyRenderer renderer(any_renderer, {options.source, options.target},
                                options.objective.lights.front());
  const ModelDescription source = recast(renderer.model(options.source), options.source_roles);
  const ModelDescription target = recast(renderer.model(options.target), options.target_roles);
  if (options.count == 0) throw usage_error("samples: must be at least 1");
  const PictureTaker picture_taker(renderer, options.objective, options.resolution, options.samples_per_axis);
  const Matching matching = make_matching(options, picture_taker, source, target);
  const std::vector<std::vector<double>> samples = draw(options, matching.varied);
  MaterialTable table = empty_table(renderer, matching);
  table.rows.resize(samples.size());
  std::mutex mutex;
  std::size_t done = 0;
  run_parallel(samples.size(), execution.jobs, [&](std::size_t i) {
    if (execution.cancelled != nullptr && *execution.cancelled)
      throw Error(ErrorKind::kInterrupted, "sweep: interrupted; nothing was written");
    table.rows[i] = matched_row(matching, samples[i]);
    const std::lock_guard lock(mutex);
    if (execution.progress) execution.progress(++done, samples.size());
  });
  return table;
}

}  // namespace remap
