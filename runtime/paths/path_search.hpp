// This file finds the least paths through a directed graph of numbered nodes and edges. path.hpp explains
// what paths mean here.
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
  std::vector<DirectedEdge> edges;  // two nodes may have several edges
  // If false, a path that visits two nodes joined by an edge must use such an edge. Waypoints divide a path
  // into legs, and the rule applies to each leg separately.
  bool detours = true;
};

// Returns for each node whether it can be reached from `start`. `start` itself is reached. If `forwards` is
// false, edges are followed backwards.
std::vector<bool> connected(const DirectedGraph& graph, std::size_t start, bool forwards);

// Returns up to `count` paths that pass through `waypoints` (2 or more, each once) in this order and visit no
// node twice. A path is a list of edge numbers. Paths are sorted by rising cost, then by rising number of
// edges, then by the edge numbers. Empty if no path exists.
std::vector<std::vector<std::size_t>> least_paths(const DirectedGraph& graph,
                                                  const std::vector<std::size_t>& waypoints,
                                                  std::size_t count);

}  // namespace remap
