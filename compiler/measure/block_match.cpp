#include "measure/block_match.hpp"

#include <algorithm>
#include <optional>

#include "core/number_text.hpp"
#include "measure/match.hpp"

namespace remap {
namespace {

TableRow flat_row(const MappedTexel& sample, const ProbedModel& target) {
  const double alpha = std::clamp(sample.alpha, target.model.alpha.min, target.model.alpha.max);
  return {sample.alpha, sample.specular, alpha, target.linear_range().min, 0.0, RowStatus::kFlat, 0};
}

// A WidthMatch matches width and specular at one source width, from pictures without diffuse.
class WidthMatch {
 public:
  WidthMatch(const SweepSetup& setup, const SampleBlock& block)
      : setup_(setup), alpha_(setup.options.samples[block.front()].alpha) {
    const SpecularResponse& source = setup.source.response;
    const bool uniform = setup.options.objective.weighting == Weighting::kUniform;
    if (setup.target.bank && (source.proportional() || (source.affine() && uniform)))
      share_products();
    else if (!source.affine() || setup.source.model.is_external)
      interpolate(block.size());
  }

  TableRow at(const MappedTexel& sample) {
    if (sample.specular == 0.0 || is_black_) return flat_row(sample, setup_.target);
    Match match;
    if (shared_) {
      std::vector<std::size_t> minima;  // materials share products, so each can search the whole bank
      std::vector<double> coefficients = {std::min(sample.specular, setup_.source.linear_range().max)};
      if (!setup_.source.response.proportional()) coefficients.push_back(1.0);
      match = shared_->match(coefficients, &minima);
    } else {
      JointChannel source{picture(sample.specular), {}};
      if (source.is_black()) return flat_row(sample, setup_.target);
      source.weights = setup_.picture_taker.weights(source.picture);
      match = match_by_itself(std::move(source));
    }
    const RoleValues& point = match.point();
    return {sample.alpha, sample.specular, point.alpha, point.specular, match.picture_error, match.status, 0};
  }

 private:
  // An affine source has only two basic pictures, and all others are combinations of these. If the weights do
  // not depend on specular, one set of inner products serves all samples. This holds for uniform weights, and
  // for weights relative to a picture that specular only scales.
  void share_products() {
    AffinePictures pictures = take_affine(setup_.picture_taker, setup_.source, alpha_);
    is_black_ = is_black(pictures.full);
    std::vector<std::vector<float>> basis = {std::move(pictures.slope)};
    if (!setup_.source.response.proportional()) basis.push_back(std::move(pictures.base));
    shared_.emplace(*setup_.target.bank, std::move(basis), setup_.picture_taker.weights(pictures.full));
  }

  // Interpolates the pictures of the source if this is as accurate as rendering and needs fewer renders.
  void interpolate(std::size_t sample_count) {
    family_ = setup_.source.family();
    if (family_ && family_->picture_count() >= sample_count) family_.reset();
    if (family_) pictures_ = take_family(setup_.picture_taker, setup_.source, alpha_);
  }

  std::vector<float> picture(double specular) const {
    if (!family_) return setup_.picture_taker.take(setup_.source, {alpha_, specular, 0.0});
    // This picture is black, but the combination would not be exactly 0.
    if (specular <= family_->range.min && setup_.source.response.black_base)
      return std::vector<float>(pictures_.front().size());
    // Beyond a knee, the picture does not change.
    return combined(pictures_, family_->weights_at(std::min(specular, family_->range.max)));
  }

  // Matches a target without a family by non-linear least squares. The search starts from the best points of
  // a grid.
  Match match_by_itself(JointChannel source) {
    if (setup_.target.bank)
      return Matcher(*setup_.target.bank, {std::move(source.picture)}, std::move(source.weights))
          .match({1.0}, &minima_);
    const std::vector<RoleValues> starts = setup_.grid->minima(source.picture, source.weights.squared);
    return JointMatcher(*setup_.target.pictures, {std::move(source)}, DiffuseSearch::kNone).match(starts);
  }

  const SweepSetup& setup_;
  double alpha_;
  std::optional<Matcher> shared_;
  bool is_black_ = false;
  std::optional<SpecularFamily> family_;
  std::vector<std::vector<float>> pictures_;  // pictures whose combinations give the family
  std::vector<std::size_t> minima_;           // minima of the previous sample
};

// The step between two samples is halved so many times to find where a regime ends.
constexpr int kJointHalvings = 6;

// Adds rows on both sides of every place where the regime (RowStatus) changes between neighbouring samples,
// because fits of two regimes must meet there.
void add_joints(const SweepSetup& setup, WidthMatch* match, std::vector<TableRow>* rows) {
  const Limits limits = setup.limits();
  for (TableRow& row : *rows) row.status = status_at(row, limits);
  std::vector<TableRow> sorted = *rows;
  std::ranges::sort(sorted, {}, &TableRow::specular1);
  const auto differ = [](const TableRow& a, const TableRow& b) {
    return a.status != b.status && has_answer(a) && has_answer(b);
  };
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
    // At most one corner lies between two samples, so at most two regimes end there.
    TableRow below = sorted[i];
    for (int joint = 0; joint < 2 && differ(below, sorted[i + 1]); ++joint) {
      const TableRow start = below;
      TableRow above = sorted[i + 1];
      // Keep the last two rows on each side. If one is held out, the other remains.
      std::vector<TableRow> on_this_side, beyond;
      for (int k = 0; k < kJointHalvings; ++k) {
        const double middle = rounded(0.5 * (below.specular1 + above.specular1), kSampleDigits);
        TableRow row = match->at({below.alpha1, middle});
        row.status = status_at(row, limits);
        (differ(row, below) ? above : below) = row;
        (differ(row, start) ? beyond : on_this_side).push_back(row);
      }
      for (const auto* side : {&on_this_side, &beyond})
        for (std::size_t k = side->size() - std::min<std::size_t>(side->size(), 2); k < side->size(); ++k)
          rows->push_back((*side)[k]);
      below = above;
    }
  }
}

// Matches diffuse separately: the target's diffuse is the source's times the ratio of the two models.
void match_diffuse_separately(const SweepSetup& setup, TableRow* row) {
  const Range range = setup.target.diffuse_range();
  const double wanted = setup.options.diffuse * setup.diffuse.scale;
  row->diffuse1 = setup.options.diffuse;
  row->diffuse2 = std::clamp(wanted, range.min, range.max);
  if (row->diffuse2 != wanted && row->status == RowStatus::kOk) row->status = RowStatus::kClamped;
}

// Compares the whole picture, with diffuse and specular. Computes its error (two stages), or does the joint
// match.
void match_whole(const SweepSetup& setup, TableRow* row) {
  const RoleValues whole{row->alpha1, row->specular1, row->diffuse1};
  if (row->status == RowStatus::kFlat) return;
  JointChannel source{setup.picture_taker.take(setup.source, whole), {}};
  if (source.is_black()) {
    row->status = RowStatus::kFlat;
    return;
  }
  source.weights = setup.picture_taker.weights(source.picture);
  const bool is_black = row->diffuse1 == 0.0 && setup.source.model.has(ParameterRole::kDiffuse);
  const JointMatcher matcher(*setup.target.pictures, {std::move(source)},
                             is_black ? DiffuseSearch::kOfBlackDiffuse : DiffuseSearch::kFree);
  const RoleValues apart{row->alpha2, row->specular2, row->diffuse2};
  if (setup.options.stages == 2) {
    const std::vector<std::vector<float>> pictures = {setup.picture_taker.take(setup.target, apart)};
    row->error = matcher.picture_error(pictures);
    return;
  }
  const Match match = matcher.match({setup.options.stages == 1 ? matcher.point_of(kFixedGuess) : apart},
                                    matcher.other_guesses());
  row->alpha2 = match.point().alpha;
  row->specular2 = match.point().specular;
  row->diffuse2 = match.point().diffuse;
  row->error = match.picture_error;
  row->status = match.status;
}

// Returns rows before a one-stage match, without target values.
std::vector<TableRow> unmatched_rows(const SweepSetup& setup, const SampleBlock& block) {
  std::vector<TableRow> rows;
  for (const std::size_t index : block) {
    const MappedTexel& sample = setup.options.samples[index];
    rows.push_back(flat_row(sample, setup.target));
    if (sample.specular != 0.0) rows.back().status = RowStatus::kOk;
  }
  return rows;
}

}  // namespace

bool has_diffuse(const SweepOptions& options) { return options.stages != 2 || options.diffuse > 0.0; }

std::vector<TableRow> match_block(const SweepSetup& setup, const SampleBlock& block) {
  std::vector<TableRow> rows;
  if (setup.options.stages == 1) {
    rows = unmatched_rows(setup, block);
  } else {
    WidthMatch match(setup, block);
    for (const std::size_t index : block) rows.push_back(match.at(setup.options.samples[index]));
    if (!has_diffuse(setup.options) && setup.target.bank) add_joints(setup, &match, &rows);
  }
  for (TableRow& row : rows) {
    if (has_diffuse(setup.options)) {
      match_diffuse_separately(setup, &row);
      match_whole(setup, &row);
    }
    const bool clamped = !setup.source_widths.contains(row.alpha1);
    if (clamped && row.status == RowStatus::kOk) row.status = RowStatus::kClamped;
  }
  return rows;
}

}  // namespace remap
