// Paths of converters from one model to another: the least expected error through the graph whose nodes are
// models and whose edges are converters.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

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

}  // namespace remap
