#include "remap/path.hpp"

#include <algorithm>
#include <cmath>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "paths/path_search.hpp"
#include "remap/shipped_converters.hpp"

namespace remap {
namespace {

constexpr double kUnitsOfError = 1e9;

double middle_alpha(const ConverterInfo& info) {
  const RoughnessEncoding convention = info.source.roughness;
  return 0.5 * (to_alpha(convention, info.roughness.min) + to_alpha(convention, info.roughness.max));
}

// Returns the names sorted, each name once.
std::vector<std::string> unique_names(std::vector<std::string> names) {
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Refuses a name that is not one of the `known` models.
[[noreturn]] void fail_unknown_model(const std::string& role, const std::string& name,
                                     const std::vector<std::string>& known) {
  std::vector<std::string> of_renderer;
  for (const std::string& model : known)
    if (!name.empty() && renderer_of(model) == name) of_renderer.push_back(model);
  if (!of_renderer.empty())
    throw usage_error(
        name + ": is a renderer, not a model (choose one of its models: " + joined(of_renderer, ", ") + ")");
  throw usage_error("unknown " + role + " '" + name + "'" + suggestion(name, known));
}

}  // namespace

double expected_error(const ConverterInfo& info) {
  const double image = info.image_rms_error.value_or(kAssumedImageError);
  const double alpha = info.roughness_rms_error.value_or(0.0) / middle_alpha(info);
  const double specular =
      info.specular_rms_error.value_or(0.0) / (0.5 * (info.specular.min + info.specular.max));
  return std::sqrt(image * image + 2.0 * alpha * alpha + specular * specular);
}

std::optional<PictureDifference> picture_difference(const ConverterPath& path) {
  PictureDifference difference;
  double squares = 0.0;
  for (const Converter* step : path.steps) {
    const ConverterInfo& info = step->info();
    if (!info.pictures && !info.image_rms_error) return std::nullopt;
    const double percent =
        info.pictures ? info.pictures->converted : kPercentOfImageError * *info.image_rms_error;
    squares += percent * percent;
  }
  difference.converted = std::sqrt(squares);
  if (path.steps.size() == 1 && path.steps.front()->info().pictures)
    difference.copied = path.steps.front()->info().pictures->copied;
  difference.is_estimate = !path.steps.empty() && !difference.copied;
  return difference;
}

std::vector<std::string> path_models(const ConverterPath& path) {
  std::vector<std::string> models = {path.steps.front()->info().source.model};
  for (const Converter* step : path.steps) models.push_back(step->info().target.model);
  return models;
}

const std::string& target_model(const ConverterPath& path) { return path.steps.back()->info().target.model; }

std::string renderer_of(const std::string& model) {
  const std::size_t slash = model.find('/');
  return slash == std::string::npos ? "" : model.substr(0, slash);
}

ConverterGraph::ConverterGraph(std::vector<const Converter*> converters, Detours detours)
    : converters_(std::move(converters)), graph_(std::make_shared<DirectedGraph>()) {
  std::ranges::sort(converters_,
                    [](const Converter* a, const Converter* b) { return a->info().id < b->info().id; });
  for (const Converter* converter : converters_) {
    models_.push_back(converter->info().source.model);
    models_.push_back(converter->info().target.model);
  }
  models_ = unique_names(std::move(models_));
  graph_->node_count = models_.size();
  for (const Converter* converter : converters_) {
    const ConverterInfo& info = converter->info();
    graph_->edges.push_back({node(info.source.model), node(info.target.model),
                             std::llround(expected_error(info) * kUnitsOfError)});
  }
  graph_->detours = detours == Detours::kAllowed;
  if (detours == Detours::kRefused) hold_against_measured();
}

void ConverterGraph::hold_against_measured() {
  for (std::size_t i = 0; i < converters_.size(); ++i) {
    if (converters_[i]->info().image_rms_error) continue;
    DirectedEdge& edge = graph_->edges[i];
    for (std::size_t j = 0; j < converters_.size(); ++j) {
      const DirectedEdge& other = graph_->edges[j];
      if (converters_[j]->info().image_rms_error && other.from == edge.from && other.to == edge.to)
        edge.cost = std::max(edge.cost, other.cost + 1);
    }
  }
}

// Returns the index of `model`, which must be in the graph.
std::size_t ConverterGraph::node(const std::string& model) const {
  return static_cast<std::size_t>(std::lower_bound(models_.begin(), models_.end(), model) - models_.begin());
}

std::vector<std::string> ConverterGraph::names_connected(const std::string& model, bool forwards) const {
  std::vector<std::string> names;
  if (!has_model(model)) return names;
  const std::vector<bool> met = connected(*graph_, node(model), forwards);
  for (std::size_t i = 0; i < models_.size(); ++i)
    if (met[i] && models_[i] != model) names.push_back(models_[i]);
  return names;
}

bool ConverterGraph::has_model(const std::string& name) const { return contains(models_, name); }

std::vector<std::string> ConverterGraph::reachable_from(const std::string& model) const {
  return names_connected(model, true);
}

std::vector<std::string> ConverterGraph::reaching(const std::string& model) const {
  return names_connected(model, false);
}

std::vector<std::string> ConverterGraph::models_of(const std::string& renderer) const {
  std::vector<std::string> models;
  for (const std::string& model : models_)
    if (!renderer.empty() && renderer_of(model) == renderer) models.push_back(model);
  return models;
}

ConverterPath ConverterGraph::path_of(const std::vector<std::size_t>& edges) const {
  ConverterPath path;
  std::int64_t error = 0;
  for (const std::size_t edge : edges) {
    path.steps.push_back(converters_[edge]);
    error += graph_->edges[edge].cost;
  }
  path.expected_error = static_cast<double>(error) / kUnitsOfError;
  return path;
}

std::vector<ConverterPath> ConverterGraph::find_paths(const PathRequest& request, std::size_t count) const {
  const std::vector<std::size_t> nodes = waypoints(request);
  std::vector<ConverterPath> paths;
  for (const std::vector<std::size_t>& edges : least_paths(*graph_, nodes, count))
    paths.push_back(path_of(edges));
  if (paths.empty()) refuse(nodes);
  return paths;
}

std::vector<ConverterPath> ConverterGraph::paths_to_renderer(const PathRequest& request) const {
  std::vector<ConverterPath> paths;
  for (const std::string& model : models_of(request.target)) {
    if (model == request.source || contains(request.via, model)) continue;
    const std::vector<std::size_t> nodes = waypoints({request.source, model, request.via});
    for (const std::vector<std::size_t>& edges : least_paths(*graph_, nodes, 1))
      paths.push_back(path_of(edges));
  }
  return paths;
}

// Returns the models that a path must pass, each once. All of them must be in the graph.
std::vector<std::size_t> ConverterGraph::waypoints(const PathRequest& request) const {
  std::vector<std::string> sources, targets;
  for (const Converter* converter : converters_) {
    sources.push_back(converter->info().source.model);
    targets.push_back(converter->info().target.model);
  }
  std::vector<std::size_t> nodes;
  const auto add = [&](const std::string& model, const char* role, std::vector<std::string> known) {
    if (!has_model(model)) fail_unknown_model(role, model, unique_names(std::move(known)));
    if (contains(nodes, node(model)))
      throw usage_error(model +
                        (model == request.source && model == request.target && request.via.empty()
                             ? ": source and target are the same model (choose another model for one of them)"
                             : ": the path would use this model twice (choose another model)"));
    nodes.push_back(node(model));
  };
  add(request.source, "source model", sources);
  for (const std::string& model : request.via) add(model, "model", models_);
  add(request.target, "target model", targets);
  return nodes;
}

// Throws an error that explains why no path goes through `waypoints`.
void ConverterGraph::refuse(const std::vector<std::size_t>& waypoints) const {
  std::vector<std::string> walk = {models_[waypoints.front()]};
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const std::string &from = models_[waypoints[i]], &to = models_[waypoints[i + 1]];
    const auto legs = least_paths(*graph_, {waypoints[i], waypoints[i + 1]}, 1);
    if (legs.empty()) {
      const std::vector<std::string> reached = reachable_from(from), reaching_it = reaching(to);
      throw usage_error(from + " to " + to + ": no converters join these models (" + from + " can become " +
                        (reached.empty() ? "no other model" : joined(reached, ", ")) +
                        (reached.size() < 2 ? "" : "; most similar name: " + closest_name(to, reached)) +
                        "; " +
                        (reaching_it.empty() ? "no model can become " + to
                                             : to + " can be made from " + joined(reaching_it, ", ")) +
                        ")");
    }
    for (const std::size_t edge : legs.front()) walk.push_back(models_[graph_->edges[edge].to]);
  }
  std::string twice;
  for (std::size_t i = 0; i < walk.size() && twice.empty(); ++i)
    if (std::find(walk.begin(), walk.begin() + static_cast<std::ptrdiff_t>(i), walk[i]) !=
        walk.begin() + static_cast<std::ptrdiff_t>(i))
      twice = walk[i];
  throw usage_error(joined(walk, " -> ") + ": visits " + twice +
                    " twice, as every path through these models does (choose other models)");
}

ModelSide ConverterGraph::side_of(const std::string& model) const {
  for (const Converter* converter : converters_) {
    if (converter->info().source.model == model) return converter->info().source;
    if (converter->info().target.model == model) return converter->info().target;
  }
  return {};
}

ConverterGraph graph_of(const ConverterList& converters) {
  std::vector<const Converter*> all;
  for (const auto& converter : converters) all.push_back(converter.get());
  return ConverterGraph(std::move(all), Detours::kRefused);
}

ConverterGraph shipped_graph(InstructionSet set) { return graph_of(shipped_converters(set)); }

namespace {

// Returns the area of the source's alpha and specular plane that all steps cover.
double covered_area(const ConverterPath& path) {
  const SourceDomain domain = chained_domain(path.steps);
  const RoughnessEncoding convention = path.steps.front()->info().source.roughness;
  const double alphas =
      std::fabs(to_alpha(convention, domain.roughness.max) - to_alpha(convention, domain.roughness.min));
  return alphas * (domain.specular.max - domain.specular.min);
}

bool is_less(const ConverterPath& a, const ConverterPath& b) {
  return rounded_up(a.expected_error, 3) < rounded_up(b.expected_error, 3);
}

}  // namespace

bool is_copy(const ConverterPath& path) {
  return std::ranges::all_of(path.steps, [](const Converter* step) { return step->info().is_copy; });
}

bool is_measured(const ConverterPath& path) {
  return std::ranges::all_of(path.steps,
                             [](const Converter* step) { return step->info().image_rms_error.has_value(); });
}

const ConverterPath& closest_path(const std::vector<ConverterPath>& paths) {
  std::vector<double> areas;
  for (const ConverterPath& path : paths) areas.push_back(covered_area(path));
  const double least_area = kLeastCoverage * *std::ranges::max_element(areas);
  const ConverterPath* closest = nullptr;
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (areas[i] >= least_area && (closest == nullptr || is_less(paths[i], *closest))) closest = &paths[i];
  return *closest;
}

std::optional<ConverterPath> closer_path(const ConverterPath& path,
                                         const std::vector<ConverterPath>& others) {
  const std::string& model = target_model(path);
  const std::string renderer = renderer_of(model);
  if (!is_measured(path) || path.expected_error <= kUnseenError || renderer.empty()) return std::nullopt;
  std::vector<ConverterPath> closer;
  for (const ConverterPath& other : others)
    if (target_model(other) != model && renderer_of(target_model(other)) == renderer &&
        other.expected_error <= kCloserShare * path.expected_error && is_measured(other))
      closer.push_back(other);
  if (closer.empty()) return std::nullopt;
  const double least_area = kLeastCoverage * covered_area(path);
  std::erase_if(closer, [&](const ConverterPath& other) { return covered_area(other) < least_area; });
  if (closer.empty()) return std::nullopt;
  return *std::min_element(closer.begin(), closer.end(), is_less);
}

}  // namespace remap
