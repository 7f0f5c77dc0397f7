// This file holds the stages of the search. A task of a thread is one candidate with one fold.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <random>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "fit/svr/svr.hpp"
#include "lower/evaluate.hpp"

namespace remap {
namespace {

constexpr std::size_t kFewestSamples = 8;
constexpr std::size_t kFolds = 5;
constexpr std::size_t kFirstFolds = 2;  // after so many folds, hopeless candidates are dropped
// A candidate is hopeless if its error is more than this many times the best error.
constexpr double kHopeless = 1.5;
constexpr double kProgress = 0.99;  // a new error is an improvement if it is at most this times the old error
// This replaces kProgress for a tube of a third of the width, whose training takes three times as long.
constexpr double kWorthTime = 0.9;
constexpr std::size_t kNeverJudges = kFolds;

// As measured on the published table, more samples change the choice little. The time of a training grows
// faster than the square of their number.
constexpr std::size_t kGridSamples = 250;
constexpr std::size_t kPatternSamples = 400;
constexpr std::size_t kTubeSamples = 600;

// These are the axes of the search. Steps are a quarter of a decade, for poles half a decade.
enum Axis { kCost, kGamma, kSpan, kPole, kEpsilon, kAxes };
using Point = std::array<int, kAxes>;

// These bounds are in steps of value_of() and pole_of(). They mean: C 1 to 100, gamma 0.1 to 3200, span 0.01
// to 1, pole 0 or 0.01 to 1, epsilon 0.0001 to 0.1. libsvm needs minutes for a larger C and a wide kernel.
constexpr Point kLowest = {0, -4, -8, 0, -16}, kHighest = {8, 14, 0, 5, -4};
constexpr int kStartCost = 4;
constexpr int kFirstStep = 2, kLargestRounds = 8;
// The training time is inversely proportional to the width of the tube, so only small problems use narrow
// tubes.
constexpr std::size_t kSmallProblem = 100;
constexpr int first_tube(std::size_t sample_count) { return sample_count <= kSmallProblem ? -16 : -12; }
constexpr int narrowest_tube(std::size_t sample_count) { return sample_count <= kSmallProblem ? -16 : -14; }

// Returns 10^(step / 4), rounded to two digits to keep records short.
double value_of(int step) {
  constexpr std::array<double, 4> kDigits = {10.0, 18.0, 32.0, 56.0};
  const int decade = (step + 40) / 4 - 10;
  const double digits = kDigits[static_cast<std::size_t>(step - 4 * decade)];
  return decade >= 1 ? digits * std::pow(10.0, decade - 1) : digits / std::pow(10.0, 1 - decade);
}

// Returns the pole of a step. A larger step gives more resolution at small alpha.
double pole_of(int step) { return step == 0 ? 0.0 : value_of(2 * (1 - step)); }

SvrHyperParameters parameters_at(const Point& point) {
  return {value_of(point[kCost]), value_of(point[kGamma]), value_of(point[kEpsilon]), value_of(point[kSpan]),
          pole_of(point[kPole])};
}

// Returns the fold in which each sample is held out, or kNeverJudges.
std::vector<std::size_t> folds_of(const Samples& samples, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::size_t> fold(samples.count());
  std::array<std::size_t, kFolds> order{};
  for (std::size_t i = 0; i < fold.size(); ++i) {
    if (i % kFolds == 0) {  // five neighbors go to the five folds in random order
      for (std::size_t k = 0; k < kFolds; ++k) order[k] = k;
      for (std::size_t k = kFolds; k > 1; --k) std::swap(order[k - 1], order[random() % k]);
    }
    fold[i] = order[i % kFolds];
  }
  if (samples.input_count == 1) fold.front() = fold.back() = kNeverJudges;
  return fold;
}

struct Judgement {
  double square_sum = 0.0;
  std::size_t count = 0;
  std::size_t vector_count = 0;
};

// Trains on the samples of the other folds and judges the samples of `fold`.
Judgement judge(const Samples& all, const std::vector<std::size_t>& folds,
                const SvrHyperParameters& parameters, std::size_t fold) {
  Samples training{all.input_count, 1, {}, {}};
  for (std::size_t i = 0; i < all.count(); ++i) {
    if (folds[i] == fold) continue;
    const auto begin = all.inputs.begin() + static_cast<std::ptrdiff_t>(i * all.input_count);
    training.inputs.insert(training.inputs.end(), begin,
                           begin + static_cast<std::ptrdiff_t>(all.input_count));
    training.outputs.push_back(all.outputs[i]);
  }
  const auto expansion = train_expansion(training, parameters);
  Judgement judgement;
  for (std::size_t i = 0; i < all.count(); ++i) {
    if (folds[i] != fold) continue;
    ++judgement.count;
    if (!expansion) continue;
    const double specular = all.input_count > 1 ? all.inputs[2 * i + 1] : 0.0;
    const double error =
        expansion_value(*expansion, all.inputs[i * all.input_count], specular) - all.outputs[i];
    judgement.square_sum += error * error;
  }
  if (expansion)
    judgement.vector_count = expansion->count();
  else
    judgement.square_sum = std::numeric_limits<double>::infinity();
  return judgement;
}

struct Trial {
  Point point{};
  std::vector<Judgement> folds;

  bool is_finished() const { return folds.size() == kFolds; }
  double rms() const { return rms_of(folds.size()); }
  double rms_of(std::size_t fold_count) const {
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < fold_count; ++k) {
      sum += folds[k].square_sum;
      count += static_cast<double>(folds[k].count);
    }
    return std::sqrt(sum / count);
  }
  double standard_error() const {
    double mean = 0.0, variance = 0.0;
    const auto root = [](const Judgement& fold) {
      return std::sqrt(fold.square_sum / static_cast<double>(std::max<std::size_t>(1, fold.count)));
    };
    for (const Judgement& fold : folds) mean += root(fold) / kFolds;
    for (const Judgement& fold : folds) variance += (root(fold) - mean) * (root(fold) - mean) / (kFolds - 1);
    return std::sqrt(variance / kFolds);
  }
  std::size_t vector_count() const {
    std::size_t sum = 0;
    for (const Judgement& fold : folds) sum += fold.vector_count;
    return sum / folds.size();
  }
};

// A Contest holds the candidates of one stage. Each point is evaluated once.
class Contest {
 public:
  Contest(Samples samples, std::uint64_t seed, unsigned jobs)
      : samples_(std::move(samples)), folds_(folds_of(samples_, seed)), jobs_(jobs) {}

  // Evaluates new points on the first folds, and then the promising points on the other folds.
  void enter(const std::vector<Point>& points) {
    std::vector<Trial*> entered;
    for (const Point& point : points) {
      const auto [found, is_new] = candidates_.try_emplace(point, Trial{point, {}});
      if (is_new) entered.push_back(&found->second);
    }
    run(entered, kFirstFolds);
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [point, candidate] : candidates_) best = std::min(best, candidate.rms_of(kFirstFolds));
    std::erase_if(entered, [best](const Trial* candidate) {
      return !(candidate->rms_of(kFirstFolds) <= kHopeless * best);
    });
    run(entered, kFolds);
    if (progress_) progress_(1.0);
  }

  // Returns the finished candidate with the smallest error. If several have this error, returns the first.
  const Trial& best() const {
    const Trial* best = nullptr;
    for (const auto& [point, candidate] : candidates_)
      if (candidate.is_finished() && (best == nullptr || candidate.rms() < best->rms())) best = &candidate;
    if (best == nullptr || !std::isfinite(best->rms()))
      throw numeric_error(
          "svr: no candidate of the search converged (check the table for outliers with remapc check)");
    return *best;
  }

  // Returns the smoothest candidate within one standard error of the best.
  const Trial& smoothest() const {
    const Trial* choice = &best();
    const double limit = choice->rms() + choice->standard_error();
    const auto roughness = [](const Trial& candidate) {
      return std::array<double, 3>{static_cast<double>(candidate.point[kGamma]),
                                   static_cast<double>(candidate.vector_count()), candidate.rms()};
    };
    for (const auto& [point, candidate] : candidates_)
      if (candidate.is_finished() && candidate.rms() <= limit && roughness(candidate) < roughness(*choice))
        choice = &candidate;
    return *choice;
  }

  const Trial& at(const Point& point) const { return candidates_.at(point); }
  std::size_t size() const { return candidates_.size(); }
  std::size_t sample_count() const { return samples_.count(); }
  void report_to(FitProgress progress) { progress_ = std::move(progress); }

 private:
  // Evaluates each trial in `entered` on `fold_count` folds.
  void run(const std::vector<Trial*>& entered, std::size_t fold_count) {
    if (entered.empty()) return;
    const std::size_t begin = entered.front()->folds.size(), folds = fold_count - begin;
    for (Trial* candidate : entered) candidate->folds.resize(fold_count);
    std::size_t done = 0;
    std::mutex mutex;
    run_parallel(entered.size() * folds, jobs_, [&](std::size_t task) {
      Trial& candidate = *entered[task / folds];
      const std::size_t fold = begin + task % folds;
      candidate.folds[fold] = judge(samples_, folds_, parameters_at(candidate.point), fold);
      const std::lock_guard lock(mutex);
      ++done;
      const double share = static_cast<double>(done) / static_cast<double>(entered.size() * folds);
      if (progress_) progress_(begin == 0 ? 0.5 * share : 0.5 + 0.5 * share);
    });
  }

  Samples samples_;
  std::vector<std::size_t> folds_;
  unsigned jobs_;
  FitProgress progress_;
  std::map<Point, Trial> candidates_;
};

std::vector<Point> grid(std::size_t input_count, int epsilon) {
  std::vector<Point> points;
  for (int gamma = -2; gamma <= 12; gamma += 2)
    for (int span = input_count > 1 ? -6 : 0; span <= 0; span += 2)
      for (const int pole : {0, 3}) points.push_back({kStartCost, gamma, span, pole, epsilon});
  return points;
}

// Returns the points at a distance of one step along each axis. Also returns points on the diagonal on which
// C and gamma compensate each other.
std::vector<Point> neighbours(const Point& centre, int step, std::size_t input_count) {
  std::vector<Point> moves = {{1, 0, 0, 0, 0},  {-1, 0, 0, 0, 0}, {0, 1, 0, 0, 0}, {0, -1, 0, 0, 0},
                              {1, -1, 0, 0, 0}, {0, 0, 0, 1, 0},  {0, 0, 0, -1, 0}};
  if (input_count > 1) moves.insert(moves.end(), {{0, 0, 1, 0, 0}, {0, 0, -1, 0, 0}});
  std::vector<Point> points;
  for (const Point& move : moves) {
    Point point = centre;
    for (std::size_t axis = 0; axis < kAxes; ++axis)
      point[axis] = std::clamp(point[axis] + step * move[axis], kLowest[axis], kHighest[axis]);
    if (point != centre) points.push_back(point);
  }
  return points;
}

// Moves from `point` along `axis`, at most to `limit`, while each step reduces the error to less than
// `needed` times its value.
Point follow(Contest& contest, Point point, Axis axis, int step, int limit, double needed) {
  for (Point next = point;; point = next) {
    next[axis] += step;
    if (step < 0 ? next[axis] < limit : next[axis] > limit) return point;
    contest.enter({next});
    const Trial& candidate = contest.at(next);
    if (!candidate.is_finished() || !(candidate.rms() < needed * contest.at(point).rms())) return point;
  }
}

// Makes the tube narrower as long as this reduces the error. Otherwise, makes it wider as long as the error
// stays the same. A narrow tube shows differences between kernels that a wide tube hides. So larger values of
// gamma are then tried again.
Point choose_tube(Contest& contest, const Point& start, int narrowest) {
  contest.enter({start});
  Point point = follow(contest, start, kEpsilon, -2, narrowest, kWorthTime);
  if (point == start) return follow(contest, start, kEpsilon, 2, kHighest[kEpsilon], 1.0);
  return follow(contest, point, kGamma, 1, kHighest[kGamma], kWorthTime);
}

}  // namespace

Samples draw_evenly(const Samples& samples, std::size_t count, std::uint64_t seed) {
  if (samples.count() <= count) return samples;
  std::mt19937_64 random(seed);
  Samples drawn{samples.input_count, 1, {}, {}};
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = k * samples.count() / count, end = (k + 1) * samples.count() / count;
    const std::size_t chosen = begin + random() % (end - begin);
    for (std::size_t j = 0; j < samples.input_count; ++j)
      drawn.inputs.push_back(samples.inputs[chosen * samples.input_count + j]);
    drawn.outputs.push_back(samples.outputs[chosen]);
  }
  return drawn;
}

SvrChoice search_hyper_parameters(const Samples& samples, std::uint64_t seed, unsigned jobs,
                                  const FitProgress& progress) {
  SvrChoice choice;
  if (samples.count() < kFewestSamples) return choice;
  const auto contest = [&](std::size_t sample_count) {
    return Contest(draw_evenly(samples, sample_count, seed), seed, jobs);
  };

  Contest coarse = contest(kGridSamples);
  coarse.report_to(part_of(progress, 0.0, 0.2));
  coarse.enter(grid(samples.input_count, first_tube(samples.count())));
  Point centre = coarse.best().point;

  Contest fine = contest(kPatternSamples);
  fine.enter({centre});
  for (int step = kFirstStep, round = 0; step >= 1 && round < kLargestRounds; ++round) {
    const double begin = 0.2 + 0.5 * round / kLargestRounds;
    fine.report_to(part_of(progress, begin, begin + 0.5 / kLargestRounds));
    const double before = fine.best().rms();
    fine.enter(neighbours(centre, step, samples.input_count));
    if (fine.best().rms() < kProgress * before)
      centre = fine.best().point;
    else
      step /= 2;
  }
  centre = fine.smoothest().point;

  Contest tube = contest(kTubeSamples);
  tube.report_to(part_of(progress, 0.7, 1.0));
  centre = choose_tube(tube, centre, narrowest_tube(samples.count()));

  choice.parameters = parameters_at(centre);
  choice.rms = tube.at(centre).rms();
  choice.fold_count = kFolds;
  choice.candidate_count = coarse.size() + fine.size() + tube.size();
  choice.sample_count = tube.sample_count();
  return choice;
}

}  // namespace remap
