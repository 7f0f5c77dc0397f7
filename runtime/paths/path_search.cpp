#include "paths/path_search.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace remap {
namespace {

using Cost = std::int64_t;

// Returns the least cost from one node to another, over nodes that are not closed (Dijkstra 1959). Returns
// nothing if no such path exists.
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

// A Beginning is the first part of a path. `bound` is its cost plus the least cost of the rest.
struct Beginning {
  Cost bound = 0;
  Cost cost = 0;
  std::vector<std::size_t> edges;
  std::size_t node = 0;
  std::size_t next = 1;  // index of the waypoint to reach next

  bool operator>(const Beginning& other) const {
    const std::size_t count = edges.size(), other_count = other.edges.size();
    return std::tie(bound, count, edges) > std::tie(other.bound, other_count, other.edges);
  }
};

// A Search extends beginnings in the order that paths must have. A path never sorts before its beginnings. So
// the first path that is complete is the least, and the second is the next. The least cost of the rest may
// use nodes that the beginning has visited. A beginning that cannot reach a waypoint any more is dropped at
// once.
class Search {
 public:
  Search(const DirectedGraph& graph, const std::vector<std::size_t>& waypoints)
      : graph_(graph), waypoints_(waypoints) {
    Beginning start;
    start.node = waypoints.front();
    push(std::move(start));
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
  // Marks the nodes that the beginning must not enter: visited nodes, and waypoints whose turn has not come.
  std::vector<bool> closed(const Beginning& beginning) const {
    std::vector<bool> nodes(graph_.node_count, false);
    for (const std::size_t edge : beginning.edges) nodes[graph_.edges[edge].from] = true;
    for (const std::size_t node : waypoints_) nodes[node] = true;
    nodes[beginning.node] = true;
    nodes[waypoints_[beginning.next]] = false;
    return nodes;
  }

  // Returns true if an earlier node since the last waypoint has a direct edge to the end of `edge`, so that a
  // path with this edge would be a detour.
  bool goes_round(const Beginning& beginning, const DirectedEdge& edge) const {
    if (graph_.detours) return false;
    const std::size_t leg_start = waypoints_[beginning.next - 1];
    for (auto step = beginning.edges.rbegin(); step != beginning.edges.rend(); ++step) {
      if (graph_.edges[*step].to == leg_start) return false;
      const std::size_t left = graph_.edges[*step].from;
      if (std::ranges::any_of(graph_.edges, [&](const DirectedEdge& other) {
            return other.from == left && other.to == edge.to;
          }))
        return true;
    }
    return false;
  }

  void extend(const Beginning& beginning) {
    const std::vector<bool> nodes = closed(beginning);
    for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
      const DirectedEdge& edge = graph_.edges[i];
      if (edge.from != beginning.node || nodes[edge.to] || goes_round(beginning, edge)) continue;
      Beginning longer = beginning;
      longer.cost += edge.cost;
      longer.edges.push_back(i);
      longer.node = edge.to;
      longer.next += edge.to == waypoints_[beginning.next];
      push(std::move(longer));
    }
  }

  // Returns the least cost from the last node of the beginning through the remaining waypoints, in their
  // order.
  std::optional<Cost> least_rest(const Beginning& beginning) const {
    Beginning from = beginning;
    Cost sum = 0;
    for (; from.next < waypoints_.size(); from.node = waypoints_[from.next++]) {
      const auto leg = least_cost(graph_, from.node, waypoints_[from.next], closed(from));
      if (!leg) return std::nullopt;
      sum += *leg;
    }
    return sum;
  }

  void push(Beginning beginning) {
    const auto rest = least_rest(beginning);
    if (!rest) return;
    beginning.bound = beginning.cost + *rest;
    queue_.push(std::move(beginning));
  }

  const DirectedGraph& graph_;
  const std::vector<std::size_t>& waypoints_;
  std::priority_queue<Beginning, std::vector<Beginning>, std::greater<>> queue_;
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
