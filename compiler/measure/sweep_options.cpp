#include "measure/sweep_options.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

ParameterDescription& named(ModelDescription* model, const std::string& name) {
  const ParameterDescription& found = std::as_const(*model).parameter(name);
  return model->parameters[static_cast<std::size_t>(&found - model->parameters.data())];
}

// Gives `role` to the parameter `name`. The parameter that had this role becomes kOther and is added to
// `displaced`.
void give_role(ModelDescription* model, ParameterRole role, const std::string& name,
               std::set<std::string>* displaced) {
  if (name.empty()) return;
  ParameterDescription& chosen = named(model, name);
  for (ParameterDescription& parameter : model->parameters) {
    if (parameter.role != role || parameter.name == name) continue;
    parameter.role = ParameterRole::kOther;
    displaced->insert(parameter.name);
  }
  chosen.role = role;
  displaced->erase(name);
}

void fix(ModelDescription* model, const std::string& name, double value, std::set<std::string>* displaced) {
  ParameterDescription& parameter = named(model, name);
  if (parameter.role == ParameterRole::kRoughness || parameter.role == ParameterRole::kSpecular)
    throw usage_error(model->name + ": " + name + " is the " + std::string(role_word(parameter.role)) +
                      " of this sweep and cannot be fixed (fix another parameter)");
  require_value(*model, parameter, value);
  parameter.role = ParameterRole::kOther;
  parameter.standard = value;
  displaced->erase(name);
}

// Recomputes the range of alpha after the roughness parameter or its convention changed.
void measure_widths(ModelDescription* model) {
  const ParameterDescription& roughness = model->parameter(ParameterRole::kRoughness);
  const Range alphas = canonical_widths(model->roughness, roughness.range);
  if (!(alphas.min >= 0.0) || !(alphas.max > 0.0))
    throw usage_error(model->name + ": the range of " + roughness.name + " is invalid for the convention " +
                      std::string(encoding_name(model->roughness)) +
                      " (choose another convention: " + roughness.name + ":CONVENTION)");
  model->alpha = alphas;
}

constexpr int kWidthDigits = 4;
constexpr int kLimitDigits = 10;  // as many digits as the rows of a table

std::string yes_no(bool value) { return value ? "yes" : "no"; }

std::string pictures_text(std::size_t count) {
  return count == 1 ? "1 picture" : std::to_string(count) + " pictures";
}

std::string lights_text(const std::vector<Light>& lights) {
  std::string text;
  for (const Light& light : lights) text += (text.empty() ? "" : ",") + light_name(light);
  return text;
}

std::string versions_text(const Renderer& renderer, const PairOptions& options) {
  const std::string source = renderer.version_of(options.source),
                    target = renderer.version_of(options.target);
  return source == target ? source : source + "; " + target;
}

}  // namespace

ParameterRoles recorded_roles(const std::string& roughness, const std::string& specular,
                              const std::string& fixed) {
  ParameterRoles roles;
  roles.roughness = roughness;
  roles.specular = specular;
  std::string_view left = fixed;
  while (!left.empty()) {
    const std::string_view setting = left.substr(0, left.find(','));
    left.remove_prefix(std::min(left.size(), setting.size() + 1));
    const std::size_t equals = setting.find('=');
    const auto value =
        equals == std::string_view::npos ? std::nullopt : parse_number(setting.substr(equals + 1));
    if (!value)
      throw input_error("fixed parameters: cannot read \"" + fixed + "\" (use NAME=VALUE,NAME=VALUE)");
    roles.fixed[std::string(setting.substr(0, equals))] = *value;
  }
  return roles;
}

ModelDescription recast(const ModelDescription& model, const ParameterRoles& roles) {
  ModelDescription result = model;
  std::set<std::string> displaced;
  give_role(&result, ParameterRole::kRoughness, roles.roughness, &displaced);
  give_role(&result, ParameterRole::kSpecular, roles.specular, &displaced);
  give_role(&result, ParameterRole::kDiffuse, roles.diffuse, &displaced);
  if (roles.convention) result.roughness = *roles.convention;
  for (const auto& [name, value] : roles.fixed) fix(&result, name, value, &displaced);
  if (!displaced.empty())
    throw usage_error(model.name + ": " + *displaced.begin() +
                      " no longer has a role and needs a value (add " + *displaced.begin() +
                      "=VALUE to the fixed parameters)");
  for (const ParameterRole role : {ParameterRole::kRoughness, ParameterRole::kSpecular})
    if (model.has(role)) result.parameter(role);  // throws if the parameter has another role already
  if (!roles.roughness.empty() || roles.convention) measure_widths(&result);
  return result;
}

std::string fixed_text(const ModelDescription& model) {
  std::string text;
  for (const ParameterDescription& parameter : model.parameters)
    if (parameter.role == ParameterRole::kOther)
      text += (text.empty() ? "" : ",") + parameter.name + "=" + number_text(parameter.standard);
  return text;
}

void add_side(const std::string& role, const ProbedModel& probed_model, Comments* comments) {
  const ModelSide side = model_side(probed_model.model);
  const SpecularResponse& response = probed_model.response;
  comments->emplace_back(role, side.model);
  comments->emplace_back(role + "_roughness", std::string(encoding_name(side.roughness)));
  if (const std::string own = probed_model.model.parameter(ParameterRole::kRoughness).name;
      own != encoding_name(side.roughness))
    comments->emplace_back(role + "_roughness_parameter", own);
  comments->emplace_back(role + "_specular", side.specular);
  if (const std::string fixed = fixed_text(probed_model.model); !fixed.empty())
    comments->emplace_back(role + "_fixed", fixed);
  comments->emplace_back(role + "_specular_proportional", yes_no(response.proportional()));
  comments->emplace_back(role + "_specular_law", std::string(law_name(response.law)));
  if (response.law == SpecularLaw::kIor) comments->emplace_back(role + "_specular_column", "f0");
  if (probed_model.curve)
    comments->emplace_back(role + "_specular_interpolated",
                           pictures_text(probed_model.curve->picture_count()) + " a width");
  if (response.law == SpecularLaw::kClamped)
    comments->emplace_back(role + "_specular_knee", number_text(response.knee));
}

void add_limits(const Limits& limits, Comments* comments) {
  comments->emplace_back(kAlphaLimitComment, number_text(rounded(limits.alpha, kLimitDigits)));
  comments->emplace_back(kSpecularLimitComment, number_text(rounded(*limits.specular, kLimitDigits)));
}

void add_widths(const std::string& role, const Range& all, const Range& effective, Comments* comments) {
  if (effective == all) return;
  comments->emplace_back(role + "_effective_alpha", number_text(rounded(effective.min, kWidthDigits)) +
                                                        " to " +
                                                        number_text(rounded(effective.max, kWidthDigits)));
}

void add_noise(const std::string& role, const SteadyRenderer& renderer, const std::string& model,
               Comments* comments) {
  if (!renderer.measured(model)) return;
  const Noise& noise = renderer.noise(model);
  comments->emplace_back(role + "_noise", number_text(rounded_up(noise.level, 2)));
  if (noise.pictures > 1)
    comments->emplace_back(role + "_averaged",
                           pictures_text(static_cast<std::size_t>(noise.pictures)) + " each");
}

void add_comparison(const Renderer& renderer, const PairOptions& options, Comments* comments) {
  comments->emplace_back("renderer", versions_text(renderer, options));
  comments->emplace_back("objective", options.objective.name);
  comments->emplace_back("lights", lights_text(options.objective.lights));
  comments->emplace_back("weighting", std::string(name_of(kWeightings, options.objective.weighting)));
  if (options.objective.weighting == Weighting::kRelative)
    comments->emplace_back("weighting_floor", number_text(options.objective.floor));
  if (options.objective.compares_means())
    comments->emplace_back("mean_share", number_text(options.objective.mean_share));
}

void add_light_scale(const LightMatch& match, Comments* comments) {
  comments->emplace_back(kLightScaleComment, number_text(match.scale));
  if (match.accepted && is_wrong_light({match.scale, match.diffuse_error, false}))
    comments->emplace_back(kLightAcceptedComment, "yes");
}

void add_resolution(const PairOptions& options, Comments* comments) {
  comments->emplace_back("resolution", std::to_string(options.resolution));
  comments->emplace_back("pixel_samples", std::to_string(options.samples_per_axis) + "x" +
                                              std::to_string(options.samples_per_axis));
  comments->emplace_back("subpixel_alpha",
                         number_text(subpixel_alpha(options.resolution, options.samples_per_axis)));
}

double subpixel_alpha(int resolution, int samples_per_axis) {
  // The sphere's radius is resolution / 2 pixels. At a camera distance of 3, the half vector turns by 1.5
  // times the angle of the normal near the middle of the picture.
  return 1.5 / (0.5 * resolution * samples_per_axis);
}

}  // namespace remap
