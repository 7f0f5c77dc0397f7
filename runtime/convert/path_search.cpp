#include "convert/path_search.hpp"

#include <algorithm>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace remap {
namespace {

using Cost = std::int64_t;

// The least cost from one node to another over nodes that are not closed (Dijkstra 1959); none where they are
// not connected.
std::optional<Cost> least_cost(const DirectedGraph& graph, std::size_t from, std::size_t to,
                               std::vector<bool> closed) {
  using Reached = std::pair<Cost, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  queue.push({0, from});
  closed[from] = false;
  while (!queue.empty()) {
    const auto [cost, node] = queue.top();
    queue.pop();
    if (node == to) return cost;
    if (closed[node]) continue;
    closed[node] = true;
    for (const DirectedEdge& edge : graph.edges)
      if (edge.from == node && !closed[edge.to]) queue.push({cost + edge.cost, edge.to});
  }
  return std::nullopt;
}

// The beginning of a path. `bound` is its cost with the least that can follow.
struct Beginning {
  Cost bound = 0;
  Cost cost = 0;
  std::vector<std::size_t> edges;
  std::size_t node = 0;
  std::size_t next = 1;  // the waypoint to reach next
};

struct ComesLater {
  bool operator()(const Beginning& a, const Beginning& b) const {
    const std::size_t a_count = a.edges.size(), b_count = b.edges.size();
    return std::tie(a.bound, a_count, a.edges) > std::tie(b.bound, b_count, b.edges);
  }
};

// Takes beginnings in the order that is asked of paths. A path comes no earlier than any of its beginnings,
// so the first that is whole is the least, the second the next. Bounds leave out what the beginning has
// visited: one that leads nowhere is dropped at once, where there are no waypoints between.
class Search {
 public:
  Search(const DirectedGraph& graph, const std::vector<std::size_t>& waypoints)
      : graph_(graph), waypoints_(waypoints), rest_(waypoints.size(), 0) {
    for (std::size_t i = waypoints.size() - 1; i-- > 1 && possible_;) {
      const auto leg =
          least_cost(graph, waypoints[i], waypoints[i + 1], std::vector<bool>(graph.node_count, false));
      possible_ = leg.has_value();
      rest_[i] = rest_[i + 1] + leg.value_or(0);
    }
    Beginning start;
    start.node = waypoints.front();
    if (possible_) push(std::move(start));
  }

  std::vector<std::vector<std::size_t>> run(std::size_t count) {
    std::vector<std::vector<std::size_t>> found;
    while (!queue_.empty() && found.size() < count) {
      const Beginning beginning = queue_.top();
      queue_.pop();
      if (beginning.next == waypoints_.size())
        found.push_back(beginning.edges);
      else
        extend(beginning);
    }
    return found;
  }

 private:
  // Nodes that the beginning may not go to: visited, or waypoints whose turn it is not.
  std::vector<bool> closed(const Beginning& beginning) const {
    std::vector<bool> nodes(graph_.node_count, false);
    for (const std::size_t edge : beginning.edges) nodes[graph_.edges[edge].from] = true;
    for (const std::size_t node : waypoints_) nodes[node] = true;
    nodes[beginning.node] = true;
    nodes[waypoints_[beginning.next]] = false;
    return nodes;
  }

  void extend(const Beginning& beginning) {
    const std::vector<bool> nodes = closed(beginning);
    for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
      const DirectedEdge& edge = graph_.edges[i];
      if (edge.from != beginning.node || nodes[edge.to]) continue;
      Beginning longer = beginning;
      longer.cost += edge.cost;
      longer.edges.push_back(i);
      longer.node = edge.to;
      longer.next += edge.to == waypoints_[beginning.next];
      push(std::move(longer));
    }
  }

  void push(Beginning beginning) {
    beginning.bound = beginning.cost;
    if (beginning.next < waypoints_.size()) {
      const auto leg = least_cost(graph_, beginning.node, waypoints_[beginning.next], closed(beginning));
      if (!leg) return;
      beginning.bound += *leg + rest_[beginning.next];
    }
    queue_.push(std::move(beginning));
  }

  const DirectedGraph& graph_;
  const std::vector<std::size_t>& waypoints_;
  std::vector<Cost> rest_;  // least cost from a waypoint through all that follow
  bool possible_ = true;
  std::priority_queue<Beginning, std::vector<Beginning>, ComesLater> queue_;
};

}  // namespace

std::vector<bool> connected(const DirectedGraph& graph, std::size_t start, bool forwards) {
  std::vector<bool> met(graph.node_count, false);
  std::vector<std::size_t> open = {start};
  met[start] = true;
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    for (const DirectedEdge& edge : graph.edges) {
      const std::size_t from = forwards ? edge.from : edge.to, to = forwards ? edge.to : edge.from;
      if (from != node || met[to]) continue;
      met[to] = true;
      open.push_back(to);
    }
  }
  return met;
}

std::vector<std::vector<std::size_t>> least_paths(const DirectedGraph& graph,
                                                  const std::vector<std::size_t>& waypoints,
                                                  std::size_t count) {
  return Search(graph, waypoints).run(count);
}

}  // namespace remap
