// Paths of converters from one model to another: the least expected error through the graph whose nodes are
// models and whose edges are converters.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remap/converter.hpp"
#include "remap/shipped_converters.hpp"

namespace remap {

struct DirectedGraph;

// The image error assumed for a converter without one, such as a published formula: a tenth of the picture,
// between the 6 % of related models and the 30 % of lobes with and without long tails.
inline constexpr double kAssumedImageError = 0.1;

// The expected error of a conversion: the RMS difference of the two pictures relative to the source's,
//   e^2 = i^2 + 2 (a / A)^2 + (s / S)^2,
// with i the image error at the best parameters (or kAssumedImageError), a and s the rms errors of the fit in
// target alpha and target specular, A and S the middles of the source's covered alpha and specular, which
// resemble those of the target. A lobe (s / alpha^2) exp(-r^2 / alpha^2) changes by sqrt(2) d, relative RMS,
// if alpha changes by the share d, and by d if specular does. The parts add in quadrature, because at the
// best parameters the remaining difference is orthogonal to every change of the parameters.
double expected_error(const ConverterInfo& info);

// Converters that follow one another from the first one's source to the last one's target.
struct ConverterPath {
  std::vector<const Converter*> steps;
  // The sum over the steps. It is linear, because the differences of two steps are fixed pictures, which need
  // not cancel.
  double expected_error = 0.0;
};

// How far pictures of a path's results differ from those of its source: the figure for people.
struct PathDifference {
  double converted = 0.0;        // RMSE of display values, percent
  std::optional<double> copied;  // of copied numbers; known for a single step that was measured
  bool is_estimate = false;      // of several steps, or from an image error
};

// The RMSE that is expected for an image error of 1: the median of the hub's 42 pairs, of which half lie
// between 13 and 28. Image errors are of one light from the side, pictures of environments.
inline constexpr double kPercentOfImageError = 23.0;

// The steps' differences add in quadrature, since they are unrelated as a rule. 0 for a path without steps;
// none if a step has neither pictures nor an image error.
std::optional<PathDifference> picture_difference(const ConverterPath& path);

// The models of the path, from the source to the target.
std::vector<std::string> path_models(const ConverterPath& path);
// The last of them.
const std::string& target_model(const ConverterPath& path);

// The renderer that a model belongs to, the part of its name before the first slash: cycles-5 of
// cycles-5/ggx. Empty for a name without a slash.
std::string renderer_of(const std::string& model);

// From `source` to `target` through the models `via`, in their order.
struct PathRequest {
  std::string source;
  std::string target;
  std::vector<std::string> via;
};

// Whether a path may avoid a direct converter.
enum class Detours {
  kAllowed,
  // No path avoids a converter that joins two of its models, except through `via`, and a converter that was
  // not validated by rendering never beats one that was. A direct match is the best that two models allow;
  // the figures of other converters hold for other domains.
  kRefused,
};

class ConverterGraph {
 public:
  // `converters` must outlive the graph and its paths. Several may join the same two models.
  explicit ConverterGraph(std::vector<const Converter*> converters, Detours detours = Detours::kAllowed);

  // Sorted names of all models, of those that can be reached from `model`, and of those that reach it, both
  // without `model` itself.
  const std::vector<std::string>& models() const noexcept { return models_; }
  std::vector<std::string> reachable_from(const std::string& model) const;
  std::vector<std::string> reaching(const std::string& model) const;
  bool has_model(const std::string& name) const;
  // The two parameters of a model, as a converter from or to it has them; those of no model if there is none.
  ModelSide side_of(const std::string& model) const;
  // In the order of their ids.
  const std::vector<const Converter*>& converters() const noexcept { return converters_; }
  // Sorted names of the models of a renderer.
  std::vector<std::string> models_of(const std::string& renderer) const;

  // The best path to each model of the renderer `request.target` that is neither the source nor in `via`, by
  // the name of the model. Empty if the renderer has no such model that a path leads to. Throws kUsage if
  // another name is unknown or `via` would be visited twice.
  std::vector<ConverterPath> paths_to_renderer(const PathRequest& request) const;

  // Up to `count` (1 or more) paths that visit no model twice, sorted by expected error, then by the number
  // of steps, then by the ids of the steps; at least one. Errors are compared and added in units of 1e-9, so
  // that ties do not depend on the order of a sum. Throws kUsage if a name is unknown, a model would be
  // visited twice, or no path exists.
  std::vector<ConverterPath> find_paths(const PathRequest& request, std::size_t count = 1) const;

 private:
  std::size_t node(const std::string& model) const;
  std::vector<std::string> names_connected(const std::string& model, bool forwards) const;
  ConverterPath path_of(const std::vector<std::size_t>& edges) const;
  void hold_against_measured();
  std::vector<std::size_t> waypoints(const PathRequest& request) const;
  [[noreturn]] void refuse(const std::vector<std::size_t>& waypoints) const;

  std::vector<const Converter*> converters_;  // by id
  std::vector<std::string> models_;           // sorted
  std::shared_ptr<DirectedGraph> graph_;      // nodes as models_, edges as converters_, costs in 1e-9
};

// The graph of all shipped converters, without detours.
ConverterGraph shipped_graph(InstructionSet set = best_instruction_set());
// The graph of the converters of a list, which must outlive it, as that of the shipped ones.
ConverterGraph graph_of(const ConverterList& converters);

// Several converters in a row as one converter, so that maps are read and written once.

// Runs the stages of all `steps` on blocks of texels that stay in the cache. The bits are the same as if each
// step converted whole rows. There must be 1 or more steps. All convert width and specular, and none is a
// chain itself.
// - convert() counts texels outside the domain of any step, each once.
// - info() has the source of the first step, the target of the last, the domain chained_domain(), and the ids
//   of all `steps`. Errors are sums over the steps, and unknown if the error of a step is unknown.
// - self_test() runs the self-test of every step.
// Throws kInput if a step does not take the model and parameters that the step before it makes.
std::unique_ptr<Converter> make_chained_converter(const std::vector<const Converter*>& steps);

// A part of the first step's domain whose images lie in the domains of all later steps: the widest range of
// width for which they do at every covered specular, then the widest range of specular, from its lower end,
// for which they do at all those widths. Found by bisection, because the mappings are monotone; its ends are
// rounded inwards to 4 digits. Returns the first step's own domain if a sample of the part has its image
// outside, or if there is no such part around the middle.
struct SourceDomain {
  Range roughness;  // the source's own width parameter
  Range specular;
};
SourceDomain chained_domain(std::span<const Converter* const> steps);

// Which model of a renderer matches the highlight of a source best. Judged by expected errors: environments
// hide the shape of a highlight.

// Another model is closer if its expected error is at most this share. Expected errors are estimates over
// different domains, so a smaller gain may not be real.
inline constexpr double kCloserShare = 0.5;

// Up to this expected error no other model is named, because nobody would see the difference: all shipped
// converters below it have a mean SSIM of at least 0.996.
inline constexpr double kUnseenError = 0.03;

// A path is left out of a comparison if it covers less than this share of the alphas and speculars that the
// other one covers: its error says nothing about the other materials. Models of dielectrics, whose F0 ends at
// 0.04 or 0.08, cover at most 0.11 of what models of conductors do.
inline constexpr double kLeastCoverage = 0.15;

// Whether no step changes alpha or specular: all models have one lobe. Also for a path without steps.
bool is_copy(const ConverterPath& path);

// Whether the pictures of every step were compared.
bool is_measured(const ConverterPath& path);

// The path of least expected error among `paths`, which start at one source and of which there must be one
// or more. Errors that agree when rounded up to three digits are equal, and the first of equal paths is
// taken. Paths that cover less than kLeastCoverage of what the widest covers are left out.
const ConverterPath& closest_path(const std::vector<ConverterPath>& paths);

// The closest of the `others` that lead to another model of the renderer of `path`, if it is closer. None if
// no such path is, or if one of the two paths is not measured. All start at one source.
std::optional<ConverterPath> closer_path(const ConverterPath& path, const std::vector<ConverterPath>& others);

}  // namespace remap
