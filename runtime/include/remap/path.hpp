// This file finds paths of converters from one model to another. It minimises the expected error through a
// graph with models as nodes and converters as edges.
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

// This image error is assumed for a converter without one, such as a published formula. It is a tenth of the
// picture, between the 6 % of related models and the 30 % of lobes with and without long tails.
inline constexpr double kAssumedImageError = 0.1;

// Returns the expected error of a conversion, the RMS difference of the two pictures relative to the
// source's:
//   e^2 = i^2 + 2 (a / A)^2 + (s / S)^2.
// Here i is the image error at the best parameters (or kAssumedImageError). a and s are the rms errors of the
// fit in target alpha and target specular. A and S are the middles of the source's covered alpha and
// specular, which resemble the target's. If alpha changes by the fraction d, a lobe (s / alpha^2) exp(-r^2 /
// alpha^2) changes by sqrt(2) d, relative RMS. If specular changes by d, the lobe changes by d. The parts add
// in quadrature, because at the best parameters the remaining difference is orthogonal to every change of the
// parameters.
double expected_error(const ConverterInfo& info);

// A ConverterPath is a list of converters from the first one's source to the last one's target.
struct ConverterPath {
  std::vector<const Converter*> steps;
  // This is the sum over the steps. The errors are added, because the errors of two steps are fixed
  // differences of pictures, which need not cancel.
  double expected_error = 0.0;
};

// This is the expected RMSE for an image error of 1. It is the median of the 42 pairs of Mitsuba's models,
// and half of the pairs lie between 13 and 28. Image errors use one light from the side, but pictures use
// environments.
inline constexpr double kPercentOfImageError = 23.0;

// Returns how far pictures of a path's results differ from pictures of the source. `copied` is set only for a
// single step that was measured. Adds the squares of the steps' differences, because these are usually
// unrelated, and takes the root. Returns 0 for a path without steps. Returns nothing if a step has neither
// pictures nor an image error.
std::optional<PictureDifference> picture_difference(const ConverterPath& path);

std::vector<std::string> path_models(const ConverterPath& path);
// Returns the last model of the path.
const std::string& target_model(const ConverterPath& path);

// Returns the renderer of a model, the part of its name before the first slash: cycles-5 for cycles-5/ggx.
// Returns an empty text for a name without a slash.
std::string renderer_of(const std::string& model);

// A PathRequest asks for paths from `source` to `target` through the models `via`, in their order.
struct PathRequest {
  std::string source;
  std::string target;
  std::vector<std::string> via;
};

// A Detours value decides whether a path may avoid a direct converter.
enum class Detours {
  kAllowed,
  // No path avoids a converter that joins two of its models, except through `via`. A converter that was not
  // validated by rendering never beats one that was. A direct match is the best that two models allow; the
  // figures of other converters hold for other domains.
  kRefused,
};

class ConverterGraph {
 public:
  // `converters` must outlive the graph and its paths. Several converters may join the same two models.
  explicit ConverterGraph(std::vector<const Converter*> converters, Detours detours = Detours::kAllowed);

  // Return sorted names: of all models, of the models that can be reached from `model`, and of the models
  // from which `model` can be reached. The last two lists do not have `model` itself.
  const std::vector<std::string>& models() const noexcept { return models_; }
  std::vector<std::string> reachable_from(const std::string& model) const;
  std::vector<std::string> reaching(const std::string& model) const;
  bool has_model(const std::string& name) const;
  // Returns the two parameters of a model, as the converters of the model have them. Returns an empty
  // ModelSide if there are none.
  ModelSide side_of(const std::string& model) const;
  // Returns the converters in the order of their ids.
  const std::vector<const Converter*>& converters() const noexcept { return converters_; }
  // Returns the sorted names of the models of a renderer.
  std::vector<std::string> models_of(const std::string& renderer) const;

  // Returns the best path to each model of the renderer `request.target`, sorted by the name of the model.
  // Skips the source and the models in `via`. Returns nothing if no path leads to a model of the renderer.
  // Throws kUsage if another name is unknown, or if a path would visit `via` twice.
  std::vector<ConverterPath> paths_to_renderer(const PathRequest& request) const;

  // Returns up to `count` (1 or more) paths that visit no model twice, and at least one. They are sorted by
  // expected error, then by the number of steps, then by the ids of the steps. Errors are compared and added
  // in units of 1e-9, so that ties do not depend on the order of a sum. Throws kUsage if a name is unknown, a
  // model would be visited twice, or no path exists.
  std::vector<ConverterPath> find_paths(const PathRequest& request, std::size_t count = 1) const;

 private:
  std::size_t node(const std::string& model) const;
  std::vector<std::string> names_connected(const std::string& model, bool forwards) const;
  ConverterPath path_of(const std::vector<std::size_t>& edges) const;
  void hold_against_measured();
  std::vector<std::size_t> waypoints(const PathRequest& request) const;
  [[noreturn]] void refuse(const std::vector<std::size_t>& waypoints) const;

  std::vector<const Converter*> converters_;  // sorted by id
  std::vector<std::string> models_;           // sorted names
  std::shared_ptr<DirectedGraph> graph_;      // nodes as models_, edges as converters_, costs in 1e-9
};

// Returns the graph of all shipped converters, without detours.
ConverterGraph shipped_graph(InstructionSet set = best_instruction_set());
// Returns the graph of the converters of a list, which must outlive it. It has no detours.
ConverterGraph graph_of(const ConverterList& converters);

// The following function joins several converters into one, so that maps are read and written once.

// Runs the stages of all `steps` on blocks of texels that stay in the cache. The bits are the same as if each
// step converted whole rows. There must be 1 or more steps. All convert width and specular, and none is a
// chain itself.
// - convert() counts texels outside the domain of any step, each once.
// - info() has the source of the first step, the target of the last, the domain chained_domain(), and the ids
//   of all `steps`. Errors are sums over the steps, and unknown if the error of a step is unknown.
// - self_test() runs the self-test of every step.
// Throws kInput if a step does not take the model and parameters that the step before it makes.
std::unique_ptr<Converter> make_chained_converter(const std::vector<const Converter*>& steps);

// A SourceDomain is a part of the first step's domain. The steps map it into the domains of all later steps.
// It has the widest range of width for which this holds at every covered specular. Then it has the widest
// range of specular, from its lower end, for which this holds at all these widths. The ranges are found by
// bisection, because the mappings are monotone, and their ends are rounded inwards to 4 digits. If a sample
// of this part leaves a later domain, or if no such part exists around the middle, it is the whole domain of
// the first step.
struct SourceDomain {
  Range roughness;  // the source's own width parameter
  Range specular;
};
SourceDomain chained_domain(std::span<const Converter* const> steps);

// The following functions choose the model of a renderer that matches the highlight of a source best. They
// compare expected errors, because environments hide the shape of a highlight.

// Another model is closer if its expected error is at most this fraction. Expected errors are estimates over
// different domains, so a smaller gain may not be real.
inline constexpr double kCloserShare = 0.5;

// Up to this expected error texremap suggests no other model, because nobody would see the difference. All
// shipped converters below it have a mean SSIM of at least 0.996.
inline constexpr double kUnseenError = 0.03;

// A comparison skips a path that covers less than this fraction of the other path's alphas and speculars. The
// error of such a path does not describe the other materials. Models of dielectrics, whose F0 ends at 0.04 or
// 0.08, cover at most 0.11 of the range of conductors.
inline constexpr double kLeastCoverage = 0.15;

// Returns true if no step changes alpha or specular, because all models have one lobe. Also returns true for
// a path without steps.
bool is_copy(const ConverterPath& path);

// Returns true if pictures of every step were compared.
bool is_measured(const ConverterPath& path);

// Returns the path with the smallest expected error. `paths` start at one source and must not be empty.
// Errors are rounded up to three digits before they are compared, and the first of equal paths wins. Skips
// paths that cover less than kLeastCoverage of what the widest path covers.
const ConverterPath& closest_path(const std::vector<ConverterPath>& paths);

// Returns the closest of `others` that leads to another model of the same renderer, if it is closer than
// `path`. Returns nothing if there is none, or if one of the two paths is not measured. All paths start at
// one source.
std::optional<ConverterPath> closer_path(const ConverterPath& path, const std::vector<ConverterPath>& others);

}  // namespace remap
