#include "warp/simplex_search.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace remapc {
namespace {

using Point = std::vector<double>;

struct Vertex {
  Point point;
  double value = 0.0;
};

// Returns a + share * (b - a).
Point between(const Point& a, const Point& b, double share) {
  Point point(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) point[i] = a[i] + share * (b[i] - a[i]);
  return point;
}

class Simplex {
 public:
  Simplex(const std::function<double(const Point&)>& energy, int evaluations)
      : energy_(energy), left_(evaluations) {}

  // Points above the limit of evaluations are worse than all others.
  Vertex at(Point point) {
    if (left_ <= 0) return {std::move(point), std::numeric_limits<double>::infinity()};
    --left_;
    const double value = energy_(point);
    return {std::move(point), value};
  }

  Point search(const Point& start, const Point& steps) {
    vertices_.push_back(at(start));
    for (std::size_t i = 0; i < start.size() && left_ > 0; ++i) {
      Point next = start;
      next[i] += steps[i];
      vertices_.push_back(at(std::move(next)));
    }
    sort();
    while (left_ > 0) step();
    return vertices_.front().point;
  }

 private:
  void sort() {
    std::stable_sort(vertices_.begin(), vertices_.end(),
                     [](const Vertex& a, const Vertex& b) { return a.value < b.value; });
  }

  Point centroid() const {
    Point sum(vertices_.front().point.size(), 0.0);
    const std::size_t count = vertices_.size() - 1;
    for (std::size_t v = 0; v < count; ++v)
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += vertices_[v].point[i] / static_cast<double>(count);
    return sum;
  }

  // Reflects, expands or contracts the worst point, or shrinks all points towards the best.
  void step() {
    const Point middle = centroid();
    Vertex& worst = vertices_.back();
    Vertex reflected = at(between(middle, worst.point, -1.0));
    if (reflected.value < vertices_.front().value) {
      Vertex expanded = at(between(middle, worst.point, -2.0));
      worst = expanded.value < reflected.value ? std::move(expanded) : std::move(reflected);
    } else if (reflected.value < vertices_[vertices_.size() - 2].value) {
      worst = std::move(reflected);
    } else {
      const bool is_outside = reflected.value < worst.value;
      Vertex contracted = at(between(middle, worst.point, is_outside ? -0.5 : 0.5));
      if (contracted.value < std::min(reflected.value, worst.value))
        worst = std::move(contracted);
      else
        shrink();
    }
    sort();
  }

  void shrink() {
    for (std::size_t v = 1; v < vertices_.size() && left_ > 0; ++v)
      vertices_[v] = at(between(vertices_.front().point, vertices_[v].point, 0.5));
  }

  const std::function<double(const Point&)>& energy_;
  int left_;
  std::vector<Vertex> vertices_;
};

}  // namespace

std::vector<double> simplex_search(const std::vector<double>& start, const std::vector<double>& steps,
                                   int evaluations,
                                   const std::function<double(const std::vector<double>&)>& energy) {
  return Simplex(energy, evaluations).search(start, steps);
}

}  // namespace remapc
