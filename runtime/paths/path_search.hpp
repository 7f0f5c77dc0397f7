// The least paths through a directed graph of numbered nodes and edges. What the numbers stand for: path.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace remap {

struct DirectedEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  std::int64_t cost = 0;  // not negative
};

struct DirectedGraph {
  std::size_t node_count = 0;
  std::vector<DirectedEdge> edges;  // any number between the same two nodes
  // Whether a path may visit two nodes that an edge joins without taking such an edge. Waypoints part a path
  // into legs, each by itself.
  bool detours = true;
};

// For each node, whether a walk of any length, also none, leads to it from `start`; against the edges where
// not `forwards`.
std::vector<bool> connected(const DirectedGraph& graph, std::size_t start, bool forwards);

// Returns up to `count` paths that pass through `waypoints` (2 or more, each once) in this order and visit no
// node twice. A path is a list of edge numbers. Paths are sorted by rising cost, then by rising number of
// edges, then by the edge numbers. Empty if no path exists.
std::vector<std::vector<std::size_t>> least_paths(const DirectedGraph& graph,
                                                  const std::vector<std::size_t>& waypoints,
                                                  std::size_t count);

}  // namespace remap
