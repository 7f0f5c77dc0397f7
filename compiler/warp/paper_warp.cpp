#include "warp/paper_warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "warp/baselines.hpp"
#include "warp/simplex_search.hpp"

namespace remapc {
namespace {

constexpr double kSigma = 0.2;  // relative to the diagonal of the template's box
constexpr std::size_t kNeighbours = 10;
constexpr std::size_t kParameters = 10;            // varied in one simplex search
constexpr int kSearches = 300, kEvaluations = 60;  // of the energy in each simplex search
constexpr double kBeside = 1.0 / 3.0;              // offset of the points around a centroid, in bins
constexpr double kMargin = 0.5;                    // relative to the template's box, on each side

double diagonal(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

// Counts the images in each bin of the template's grid, and the bins whose occupancy differs from that of the
// template's points.
class BinOverlap {
 public:
  BinOverlap(std::size_t bins, const std::vector<long>& goal) : counts_(bins, 0), is_goal_(bins, 0) {
    for (const long bin : goal) is_goal_[static_cast<std::size_t>(bin)] = 1;
    mismatches_ = std::accumulate(is_goal_.begin(), is_goal_.end(), 0);
  }
  void add(long bin) {
    const auto b = static_cast<std::size_t>(bin);
    if (counts_[b]++ == 0) mismatches_ += is_goal_[b] != 0 ? -1 : 1;
  }
  void remove(long bin) {
    const auto b = static_cast<std::size_t>(bin);
    if (--counts_[b] == 0) mismatches_ += is_goal_[b] != 0 ? 1 : -1;
  }
  int mismatches() const { return mismatches_; }
  bool is_mismatch(long bin) const {
    const auto b = static_cast<std::size_t>(bin);
    return (counts_[b] > 0) != (is_goal_[b] != 0);
  }

 private:
  std::vector<int> counts_, is_goal_;
  int mismatches_ = 0;
};

// The template's grid with a margin. Positions beyond the margin are clamped to its edge.
class HeldGrid {
 public:
  HeldGrid(const Points& points, double spacing)
      : low_(points.colwise().minCoeff()), high_(points.colwise().maxCoeff()), grid_(corners(), spacing) {}
  std::size_t size() const { return grid_.size(); }
  long bin_of(const Eigen::RowVectorXd& point) const {
    const Eigen::RowVectorXd held = point.cwiseMax(low_).cwiseMin(high_);
    return grid_.bin_of(held.data());
  }

 private:
  Points corners() {
    const Eigen::RowVectorXd margin = kMargin * (high_ - low_);
    low_ -= margin;
    high_ += margin;
    Points both(2, low_.size());
    both << low_, high_;
    return both;
  }
  Eigen::RowVectorXd low_, high_;
  BinGrid grid_;
};

// The published energy, updated incrementally when the map of a bin changes.
class PaperEnergy {
 public:
  PaperEnergy(const PointSets& sets, const MovingAffine& start)
      : points_(sets.source.points),
        spacing_(sets.target.spacing),
        source_spacing_(sets.source.spacing),
        grid_(sets.target.points, sets.target.spacing),
        all_(grid_.size(), bins_of(sets.target.points)) {
    const auto count = static_cast<std::size_t>(points_.rows());
    strokes_of_.resize(count);
    std::size_t stroked = 0;
    for (std::size_t k = 0; k < sets.source.strokes.size(); ++k) {
      strokes_.emplace_back(grid_.size(), bins_of(sets.target.points(sets.target.strokes[k], Eigen::all)));
      for (const int bin : sets.source.strokes[k]) strokes_of_[static_cast<std::size_t>(bin)].push_back(k);
      stroked += sets.source.strokes[k].size();
    }
    stroke_weight_ = static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(stroked, 1));
    find_neighbours();
    images_of_bin_.resize(count);
    for (std::size_t b = 0; b < count; ++b) {
      maps_.push_back(affine_at(start, points_.row(static_cast<Eigen::Index>(b))));
      place(b);
    }
    for (std::size_t b = 0; b < count; ++b) roughness_ += roughness_at(b);
  }

  double value() const {
    double mismatches = 0.0;
    for (const BinOverlap& stroke : strokes_) mismatches += stroke.mismatches();
    return roughness_ + stroke_weight_ * mismatches + all_.mismatches();
  }

  std::size_t bin_count() const { return maps_.size(); }
  const std::vector<AffineMap>& maps() const { return maps_; }

  // Whether an image of the bin or of its neighbors in the source falls into a bin whose occupancy differs.
  bool is_beside_mismatch(std::size_t bin) const {
    const auto has_mismatch = [&](std::size_t b) {
      return std::any_of(images_of_bin_[b].begin(), images_of_bin_[b].end(),
                         [&](long image) { return all_.is_mismatch(image); });
    };
    if (has_mismatch(bin)) return true;
    return std::any_of(neighbours_[bin].begin(), neighbours_[bin].end(),
                       [&](const Neighbour& other) { return has_mismatch(other.bin); });
  }

  // Entry `entry` of the map of a bin: the linear part by columns, then the offset.
  double entry(std::size_t bin, std::size_t entry) const {
    const AffineMap& map = maps_[bin];
    const auto linear = static_cast<std::size_t>(map.linear.size());
    return entry < linear ? map.linear.data()[entry] : map.offset[static_cast<Eigen::Index>(entry - linear)];
  }
  void set_entry(std::size_t bin, std::size_t entry, double value) {
    roughness_ -= roughness_around(bin);
    for (const long image : images_of_bin_[bin]) count(bin, image, &BinOverlap::remove);
    AffineMap& map = maps_[bin];
    const auto linear = static_cast<std::size_t>(map.linear.size());
    if (entry < linear)
      map.linear.data()[entry] = value;
    else
      map.offset[static_cast<Eigen::Index>(entry - linear)] = value;
    place(bin);
    roughness_ += roughness_around(bin);
  }
  double step_of(std::size_t entry) const {
    return entry < static_cast<std::size_t>(points_.cols() * points_.cols()) ? 0.1 : spacing_;
  }
  std::size_t entry_count() const { return static_cast<std::size_t>(points_.cols() * (points_.cols() + 1)); }

 private:
  struct Neighbour {
    std::size_t bin = 0;
    double weight = 0.0;  // z
  };

  std::vector<long> bins_of(const Points& points) const {
    std::vector<long> bins;
    for (Eigen::Index i = 0; i < points.rows(); ++i) bins.push_back(grid_.bin_of(points.row(i)));
    return bins;
  }

  void find_neighbours() {
    const double sigma = kSigma * diagonal(points_);
    for (Eigen::Index b = 0; b < points_.rows(); ++b) {
      const Eigen::VectorXd squares = (points_.rowwise() - points_.row(b)).rowwise().squaredNorm();
      std::vector<std::size_t> order(static_cast<std::size_t>(points_.rows()));
      std::iota(order.begin(), order.end(), std::size_t{0});
      const std::size_t wanted = std::min(kNeighbours + 1, order.size());
      const auto square = [&](std::size_t i) { return squares[static_cast<Eigen::Index>(i)]; };
      std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(wanted), order.end(),
                        [&](std::size_t i, std::size_t j) {
                          return square(i) != square(j) ? square(i) < square(j) : i < j;
                        });
      neighbours_.emplace_back();
      for (std::size_t i = 0; i < wanted; ++i)
        if (order[i] != static_cast<std::size_t>(b))
          neighbours_.back().push_back({order[i], std::exp(-square(order[i]) / (2.0 * sigma * sigma))});
    }
    is_neighbour_of_.resize(neighbours_.size());
    for (std::size_t b = 0; b < neighbours_.size(); ++b)
      for (const Neighbour& other : neighbours_[b]) is_neighbour_of_[other.bin].push_back(b);
  }

  double term(std::size_t bin, const Neighbour& other) const {
    const Eigen::RowVectorXd point = points_.row(static_cast<Eigen::Index>(bin));
    const AffineMap &own = maps_[bin], &beside = maps_[other.bin];
    const Eigen::RowVectorXd difference = point * (own.linear - beside.linear) + own.offset - beside.offset;
    return other.weight * difference.squaredNorm() / (spacing_ * spacing_);
  }
  double roughness_at(std::size_t bin) const {
    double sum = 0.0;
    for (const Neighbour& other : neighbours_[bin]) sum += term(bin, other);
    return sum;
  }
  // The sum of all terms that depend on the map of a bin.
  double roughness_around(std::size_t bin) const {
    double sum = roughness_at(bin);
    for (const std::size_t from : is_neighbour_of_[bin])
      for (const Neighbour& other : neighbours_[from])
        if (other.bin == bin) sum += term(from, other);
    return sum;
  }

  void count(std::size_t bin, long image, void (BinOverlap::*change)(long)) {
    (all_.*change)(image);
    for (const std::size_t k : strokes_of_[bin]) (strokes_[k].*change)(image);
  }

  // Computes the images of the points of a bin.
  void place(std::size_t bin) {
    std::vector<long>& images = images_of_bin_[bin];
    images.clear();
    const Eigen::RowVectorXd centre = points_.row(static_cast<Eigen::Index>(bin));
    const auto add = [&](const Eigen::RowVectorXd& point) {
      images.push_back(grid_.bin_of(point * maps_[bin].linear + maps_[bin].offset));
    };
    add(centre);
    for (Eigen::Index k = 0; k < centre.size(); ++k)
      for (const double side : {-kBeside, kBeside}) {
        Eigen::RowVectorXd beside = centre;
        beside[k] += side * source_spacing_;
        add(beside);
      }
    for (const long image : images) count(bin, image, &BinOverlap::add);
  }

  const Points& points_;
  double spacing_, source_spacing_;
  HeldGrid grid_;
  BinOverlap all_;
  std::vector<BinOverlap> strokes_;
  std::vector<std::vector<std::size_t>> strokes_of_, is_neighbour_of_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<AffineMap> maps_;
  std::vector<std::vector<long>> images_of_bin_;
  double stroke_weight_ = 0.0, roughness_ = 0.0;
};

// One entry of the maps of some bins.
struct Chosen {
  std::size_t bin = 0, entry = 0;
};

std::vector<Chosen> choose(const PaperEnergy& energy, std::mt19937& random) {
  std::vector<std::size_t> bins;
  for (std::size_t b = 0; b < energy.bin_count(); ++b)
    if (energy.is_beside_mismatch(b)) bins.push_back(b);
  std::vector<Chosen> chosen;
  while (!bins.empty() && chosen.size() < kParameters) {
    const std::size_t place = random() % bins.size();
    chosen.push_back({bins[place], random() % energy.entry_count()});
    bins[place] = bins.back();
    bins.pop_back();
  }
  return chosen;
}

}  // namespace

MovingAffine initialisation_of_paper(const PointSets& sets) {
  std::vector<Eigen::RowVectorXd> from, to;
  for (std::size_t k = 0; k < sets.source.strokes.size(); ++k) {
    const Points own = sets.source.points(sets.source.strokes[k], Eigen::all);
    const Points goal = sets.target.points(sets.target.strokes[k], Eigen::all);
    const Points matched = match_histograms(own, goal);
    for (Eigen::Index i = 0; i < own.rows(); ++i) {
      Eigen::Index nearest = 0;
      (goal.rowwise() - matched.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
      from.push_back(own.row(i));
      to.push_back(goal.row(nearest));
    }
  }
  const auto count = static_cast<Eigen::Index>(from.size());
  const Eigen::Index n = sets.source.points.cols();
  MovingAffine warp{Points(count, n), Points(count, n), 1.0, affine_from_strokes(sets, kAlonePrior)};
  for (Eigen::Index i = 0; i < count; ++i) {
    warp.from.row(i) = from[static_cast<std::size_t>(i)];
    warp.to.row(i) = to[static_cast<std::size_t>(i)];
  }
  warp.width = kSigma * diagonal(sets.target.points);
  return warp;
}

PaperWarp warp_of_paper(const PointSets& sets) {
  PaperWarp result;
  result.warp.start = initialisation_of_paper(sets);
  result.warp.bins = sets.source.points;
  PaperEnergy energy(sets, result.warp.start);
  const std::vector<AffineMap> before = energy.maps();
  result.energy_before = energy.value();
  std::mt19937 random(1);
  for (int round = 0; round < kSearches; ++round) {
    const std::vector<Chosen> chosen = choose(energy, random);
    if (chosen.empty()) break;
    std::vector<double> start, steps;
    for (const Chosen& parameter : chosen) {
      start.push_back(energy.entry(parameter.bin, parameter.entry));
      steps.push_back(energy.step_of(parameter.entry));
    }
    const auto set = [&](const std::vector<double>& values) {
      for (std::size_t i = 0; i < chosen.size(); ++i)
        energy.set_entry(chosen[i].bin, chosen[i].entry, values[i]);
      return energy.value();
    };
    set(simplex_search(start, steps, kEvaluations, set));
  }
  result.energy_after = energy.value();
  for (std::size_t b = 0; b < before.size(); ++b)
    result.warp.corrections.push_back(
        {energy.maps()[b].linear - before[b].linear, energy.maps()[b].offset - before[b].offset});
  return result;
}

}  // namespace remapc
