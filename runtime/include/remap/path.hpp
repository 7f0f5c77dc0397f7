// Which converters lead from one model to another: the graph whose nodes are models and whose edges are
// converters, and the paths of least expected error through it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

struct DirectedGraph;

// Taken as the image error of a converter that does not know its own, such as a published formula: a tenth of
// the picture, between the 6 % of related models and the 30 % of lobes with and without long tails.
inline constexpr double kAssumedImageError = 0.1;

// What to expect of one conversion: the rms difference of the two pictures relative to the source's,
//   e^2 = i^2 + 2 (a / A)^2 + (s / S)^2,
// with i the image error at the best parameters (or kAssumedImageError), a and s the rms errors of the fit in
// target alpha and target specular, A and S the middles of the source's covered alpha and specular, which
// those of the target resemble. A lobe (s / alpha^2) exp(-r^2 / alpha^2) changes by sqrt(2) d, relative rms,
// where alpha changes by the share d, and by d where specular does. The parts add in quadrature, because at
// the best parameters the difference that is left is orthogonal to every change that parameters can make.
double expected_error(const ConverterInfo& info);

// Converters that follow one another from the first one's source to the last one's target.
struct ConverterPath {
  std::vector<const Converter*> steps;
  // Sum of the steps'. They add up linearly: a step differs from its source by the same picture every time,
  // and nothing makes the differences of two steps cancel.
  double expected_error = 0.0;
};

// Every model of the path, from the source to the target.
std::vector<std::string> path_models(const ConverterPath& path);

// From `source` to `target` through the models `via`, in their order.
struct PathRequest {
  std::string source;
  std::string target;
  std::vector<std::string> via;
};

// What counts beside the sum of expected errors.
enum class Detours {
  kAllowed,
  // A direct match is the best that its two models allow, whatever the figures of others say, which are of
  // other domains: no path goes round a converter that joins two of its models (but through `via`), and
  // between the same two models a converter that was not compared by pictures is not expected to beat one
  // that was.
  kRefused,
};

class ConverterGraph {
 public:
  // `converters` must outlive the graph and its paths. Two of them may join the same two models.
  explicit ConverterGraph(std::vector<const Converter*> converters, Detours detours = Detours::kAllowed);

  // Names, sorted: all; what can be reached from `model`; what `model` can be reached from. Neither of the
  // last two holds `model` itself.
  const std::vector<std::string>& models() const noexcept { return models_; }
  std::vector<std::string> reachable_from(const std::string& model) const;
  std::vector<std::string> reaching(const std::string& model) const;

  // Up to `count` (from 1) paths that visit no model twice, by rising expected error, then by their number of
  // steps, then by the ids of the steps; at least one. Errors are compared and added in whole units of 1e-9,
  // so that ties are ties whatever the order of a sum.
  // Throws kUsage where a name is unknown (with the nearest), where a model would be visited twice, and where
  // no path exists (with what the source reaches, which of it is nearest in name, and what reaches the
  // target).
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

}  // namespace remap
