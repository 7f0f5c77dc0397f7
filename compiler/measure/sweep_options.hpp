// This file holds the options of a sweep: which parameters vary, what is computed, and how it runs. It also
// writes them, and what the sweep measured, to the comments of its table.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lower/mapping.hpp"
#include "measure/objective.hpp"
#include "measure/picture_taker.hpp"
#include "measure/probe.hpp"
#include "renderer/renderer.hpp"
#include "table/table.hpp"

namespace remap {

// A ParameterRoles chooses which parameters of a model a sweep varies, and which values the other parameters
// keep. A principled material has more parameters than a sweep has roles. Base color, metallic or specular
// level can each have the role of specular. An empty name keeps the model's parameter.
struct ParameterRoles {
  std::string roughness;
  std::optional<RoughnessEncoding> convention;  // encoding of `roughness`; if unset, the model's own
  std::string specular;
  std::string diffuse;
  std::map<std::string, double> fixed;  // values by name of the parameter
};

// Reads back the roles recorded in a table of remapc sweep, from its comments `<side>_roughness_parameter`,
// `<side>_specular` and `<side>_fixed`. An empty text means a missing comment.
ParameterRoles recorded_roles(const std::string& roughness, const std::string& specular,
                              const std::string& fixed);

// Returns `model` with the roles of `roles`. Fixed parameters, and parameters that lost their role, become
// kOther and keep one value. Throws kUsage, beginning with the model's name, for an unknown parameter, for a
// value out of range, and for a parameter that lost its role but has no value.
ModelDescription recast(const ModelDescription& model, const ParameterRoles& roles);

// Returns the parameters without a role as a table records them: `metallic=1,specular=0.5`.
std::string fixed_text(const ModelDescription& model);

// A PairOptions holds two models, and how their pictures are compared.
struct PairOptions {
  std::string source;
  std::string target;
  ParameterRoles source_roles, target_roles;
  Objective objective;
  int resolution = 512;
  int samples_per_axis = 1;
  bool match_irradiance = true;
  bool accept_light = false;  // continue even if require_light() (table/table.hpp) would throw
};

// A SweepOptions holds the settings of a sweep. Every field is recorded in the table's comments.
struct SweepOptions : PairOptions {
  std::string sampling;              // how the samples were chosen, in words
  std::vector<MappedTexel> samples;  // in the order of the table; specular canonical (probe.hpp)
  int stages = 2;                    // 1, 2 or 3 (section 3.1)
  double diffuse = 0.0;              // diffuse of the source in every sample
};

// A SweepExecution decides how a sweep runs. None of this changes the table.
struct SweepExecution {
  unsigned jobs = 0;                                                // 0: one for each core
  std::function<void(std::size_t done, std::size_t all)> progress;  // called from any thread
  const std::atomic<bool>* cancelled = nullptr;  // checked between rows; throws kInterrupted
};

// Adds one side: the model, its parameters and the law of its specular.
void add_side(const std::string& role, const ProbedModel& probed_model, Comments* comments);

// Adds the limits of the target, which must be known.
void add_limits(const Limits& limits, Comments* comments);

// Adds the widths of one side that change its pictures, `effective`, if some of the widths `all` do not.
void add_widths(const std::string& role, const Range& all, const Range& effective, Comments* comments);

// Adds the noise of one side and the number of pictures that are averaged, if the noise was measured.
void add_noise(const std::string& role, const SteadyRenderer& renderer, const std::string& model,
               Comments* comments);

// Adds the renderer's version and how pictures were compared.
void add_comparison(const Renderer& renderer, const PairOptions& options, Comments* comments);

// Adds the factor between the lights. If a user had to accept it, adds this, too.
void add_light_scale(const LightMatch& match, Comments* comments);

void add_resolution(const PairOptions& options, Comments* comments);

// Returns the alpha below which the highlight of a headlight has a radius of less than one pixel sample, so
// that the picture no longer resolves it.
double subpixel_alpha(int resolution, int samples_per_axis);

}  // namespace remap
