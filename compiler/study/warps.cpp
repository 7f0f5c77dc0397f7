#include "study/warps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "remap/error.hpp"
#include "system/parallel.hpp"
#include "text/number_text.hpp"
#include "warp/warp_table.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

constexpr const char* kTruth = "truth";

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct TimedFit {
  WarpFit fit;
  double seconds = 0.0;
};

// Computes all variants of one case with one set of strokes.
class Run {
 public:
  Run(const WarpCase& studied, const WarpMeasures& measures, std::size_t stroke_set, bool keeps_converted)
      : case_(studied),
        measures_(measures),
        strokes_(studied.strokes[stroke_set]),
        keeps_converted_(keeps_converted) {}

  WarpRow row_of(const WarpVariant& variant) {
    WarpRow row;
    if (!variant.method) {
      row.copy = variant.name == kTruth ? measures_.of_truth() : measures_.nearest();
      row.figures = measures_.of_copy(row.copy, strokes_);
      return row;
    }
    const TimedFit made = fitted(variant);
    if (variant.group == WarpGroup::kNodes) {
      row.copy = plain_copy_;
      row.figures = plain_figures_;
      for (std::size_t i = 0; keeps_converted_ && i < case_.source.texels.size(); ++i)
        row.converted.push_back(remap::evaluate_warp(made.fit.compiled, case_.source.texels[i]));
    } else {
      row.copy = copy_exactly(made.fit, case_.source, case_.target);
      row.figures = measures_.of_copy(row.copy, strokes_);
    }
    if (!plain_) {  // the first variant is the registration
      plain_ = made;
      plain_copy_ = row.copy;
      plain_figures_ = row.figures;
    }
    row.cost = {made.fit.diagnostics.dimensions, 100.0 * made.fit.diagnostics.fold_share,
                measures_.of_compiled(made.fit.compiled, row.copy),
                static_cast<double>(byte_count(made.fit.compiled)), made.seconds};
    return row;
  }

 private:
  TimedFit fitted(const WarpVariant& variant) const {
    WarpOptions options;
    options.method = *variant.method;
    options.dimensions = variant.dimensions;
    options.points = variant.points;
    if (variant.nodes != 1.0) {
      const double usual = static_cast<double>(default_nodes(plain_->fit.diagnostics.dimensions, false));
      options.nodes = static_cast<std::size_t>(std::clamp(std::round(variant.nodes * usual), 2.0, 1024.0));
    }
    const double start = processor_seconds();
    WarpFit fit = fit_warp(case_.source, case_.target, strokes_, options);
    return {std::move(fit), processor_seconds() - start};
  }

  const WarpCase& case_;
  const WarpMeasures& measures_;
  const std::vector<StrokePair>& strokes_;
  const bool keeps_converted_;
  std::optional<TimedFit> plain_;
  TexelCopy plain_copy_;
  WarpFigures plain_figures_;
};

bool has_changes(const WarpVariant& variant) { return variant.method && variant.group != WarpGroup::kNodes; }

void require_options(const WarpsOptions& options) {
  if (options.cases.empty()) throw Error(ErrorKind::kUsage, "at least one set is required");
}

// Distances between the results of `rows`: all rows of one set, ordered as in WarpsResult.
std::vector<StrokeChange> changes_of(const WarpMeasures& measures, const WarpsResult& result,
                                     const WarpRow* rows, std::size_t stroke_sets) {
  std::vector<StrokeChange> changes;
  const std::size_t count = result.variants.size();
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t a = 0; has_changes(result.variants[v]) && a < stroke_sets; ++a)
      for (std::size_t b = a + 1; b < stroke_sets; ++b)
        changes.push_back(
            {rows->set, v, a, b, measures.change(rows[a * count + v].copy, rows[b * count + v].copy)});
  return changes;
}

void add(const WarpFigures& from, double share, WarpFigures* sum) {
  for (const auto part :
       {&WarpFigures::mean, &WarpFigures::rms, &WarpFigures::median, &WarpFigures::p95, &WarpFigures::strokes,
        &WarpFigures::used, &WarpFigures::tears, &WarpFigures::variation})
    sum->*part += share * from.*part;
}

void add(const WarpCost& from, double share, WarpCost* sum) {
  sum->dimensions = std::max(sum->dimensions, from.dimensions);
  for (const auto part : {&WarpCost::folds, &WarpCost::bytes, &WarpCost::seconds})
    sum->*part += share * from.*part;
  sum->compiled.mean += share * from.compiled.mean;
  sum->compiled.difference += share * from.compiled.difference;
}

}  // namespace

std::string group_name(WarpGroup group) {
  constexpr std::array<const char*, 4> kNames = {"method", "dimensions", "points", "nodes"};
  return kNames[static_cast<std::size_t>(group)];
}

std::vector<WarpVariant> warp_variants() {
  std::vector<WarpVariant> variants;
  for (const WarpMethod method :
       {WarpMethod::kRegistration, WarpMethod::kPaper, WarpMethod::kHistogram, WarpMethod::kAffine}) {
    WarpVariant& variant = variants.emplace_back();
    variant.name = remap::name_of(kWarpMethods, method);
    variant.method = method;
  }
  for (const char* name : {"nearest", kTruth}) variants.emplace_back().name = name;
  const auto add = [&](WarpGroup group, const std::string& name) -> WarpVariant& {
    WarpVariant& variant = variants.emplace_back();
    variant.group = group;
    variant.name = name;
    variant.method = WarpMethod::kRegistration;
    return variant;
  };
  for (const int dimensions : {1, 2, 3})
    add(WarpGroup::kDimensions, std::to_string(dimensions)).dimensions = dimensions;
  for (const double points : {50.0, 150.0, 350.0, 700.0, 1200.0})
    add(WarpGroup::kPoints, remap::number_text(points)).points = points;
  add(WarpGroup::kNodes, "1/8").nodes = 0.125;
  add(WarpGroup::kNodes, "1/4").nodes = 0.25;
  add(WarpGroup::kNodes, "1/2").nodes = 0.5;
  add(WarpGroup::kNodes, "1");
  add(WarpGroup::kNodes, "2").nodes = 2.0;
  return variants;
}

std::size_t progress_steps(const WarpsOptions& options) {
  std::size_t stroke_sets = 0;
  for (const WarpCase& studied : options.cases) stroke_sets += studied.strokes.size();
  return stroke_sets * warp_variants().size();
}

WarpsResult study_warps(const WarpsOptions& options) {
  require_options(options);
  WarpsResult result;
  result.variants = warp_variants();
  const std::size_t count = result.variants.size();
  for (std::size_t set = 0; set < options.cases.size(); ++set) {
    const WarpCase& studied = options.cases[set];
    const WarpMeasures measures(studied);
    const std::size_t first = result.rows.size();
    result.rows.resize(first + studied.strokes.size() * count);
    remap::run_parallel(studied.strokes.size(), options.jobs, [&](std::size_t s) {
      Run run(studied, measures, s, options.pictures && s == 0);
      for (std::size_t v = 0; v < count; ++v) {
        if (options.cancelled != nullptr && *options.cancelled)
          throw Error(ErrorKind::kInterrupted, "study: interrupted; nothing was written");
        WarpRow row = run.row_of(result.variants[v]);
        row.set = set;
        row.stroke_set = s;
        row.variant = v;
        result.rows[first + s * count + v] = std::move(row);
        if (options.progress) options.progress();
      }
    });
    const std::vector<StrokeChange> changes =
        changes_of(measures, result, &result.rows[first], studied.strokes.size());
    result.changes.insert(result.changes.end(), changes.begin(), changes.end());
    if (!options.pictures)
      for (std::size_t i = first; i < result.rows.size(); ++i) result.rows[i].copy = {};
  }
  return result;
}

WarpSummary summary_of(const WarpsResult& result, std::size_t variant, std::optional<std::size_t> set) {
  WarpSummary summary;
  const auto is_wanted = [&](const auto& item) {
    return item.variant == variant && (!set || item.set == *set);
  };
  const auto count = std::count_if(result.rows.begin(), result.rows.end(), is_wanted);
  for (const WarpRow& row : result.rows) {
    if (!is_wanted(row)) continue;
    add(row.figures, 1.0 / static_cast<double>(count), &summary.figures);
    if (!row.cost) continue;
    if (!summary.cost) summary.cost.emplace();
    add(*row.cost, 1.0 / static_cast<double>(count), &*summary.cost);
  }
  double sum = 0.0, pairs = 0.0;
  for (const StrokeChange& change : result.changes)
    if (is_wanted(change)) {
      sum += change.change;
      pairs += 1.0;
    }
  if (pairs > 0.0) summary.change = sum / pairs;
  return summary;
}

std::size_t variant_named(const WarpsResult& result, WarpGroup group, const std::string& name) {
  const auto found = std::find_if(
      result.variants.begin(), result.variants.end(),
      [&](const WarpVariant& variant) { return variant.group == group && variant.name == name; });
  return static_cast<std::size_t>(found - result.variants.begin());
}

}  // namespace remapc
