#include "sweep/block_match.hpp"

#include <algorithm>
#include <optional>

#include "match/joint_match.hpp"
#include "match/match.hpp"

namespace remapc {
namespace {

using remap::Range;

TableRow flat_row(const SamplePoint& sample, const ProbedModel& target) {
  const double alpha = std::clamp(sample.alpha, target.model.alpha.min, target.model.alpha.max);
  return {sample.alpha, sample.specular, alpha, target.linear_range().min, 0.0, RowStatus::kFlat, 0};
}

TableRow matched_row(const SamplePoint& sample, const Match& match) {
  return {sample.alpha, sample.specular, match.alpha, match.specular, match.error, match.status, 0};
}

// Matches one sample to a target without a family: specular and alpha by non-linear least squares, from the
// best points of a grid of pictures.
TableRow searched_row(const SweepSetup& setup, const SamplePoint& sample, std::vector<float> picture,
                      std::vector<float> weights) {
  const std::vector<RoleValues> starts = setup.grid->minima(picture, weights);
  const JointMatcher matcher(*setup.pictures, std::move(picture), std::move(weights), {false, false});
  const JointMatch match = matcher.best_match(starts);
  return {sample.alpha,
          sample.specular,
          match.point().alpha,
          match.point().specular,
          match.error,
          match.status,
          0};
}

// Pictures of the source at one width: rendered, or interpolated if that is as accurate and needs fewer
// renders.
class SourcePictures {
 public:
  SourcePictures(const SweepSetup& setup, const SampleBlock& block) : setup_(setup), alpha_(block.alpha) {
    const bool rendered = setup.source.response.affine() && !setup.source.model.is_external;
    if (!rendered) family_ = setup.source.family();
    if (family_ && family_->picture_count() >= block.samples.size()) family_.reset();
    if (family_) pictures_ = take_family(setup.picture_taker, setup.source, alpha_);
  }

  std::vector<float> at(double specular) const {
    if (!family_) return setup_.picture_taker.take(setup_.source, {alpha_, specular, 0.0});
    // The exact picture is black; the combination would leave rounding errors.
    if (specular <= family_->range.min && setup_.source.response.black_base)
      return std::vector<float>(pictures_.front().size());
    // The picture is constant beyond a knee.
    return combined(pictures_, family_->weights_at(std::min(specular, family_->range.max)));
  }

 private:
  const SweepSetup& setup_;
  double alpha_;
  std::optional<SpecularFamily> family_;
  std::vector<std::vector<float>> pictures_;
};

// Matches each sample by its own picture, for sources whose weights or law differ from one sample to the
// next.
std::vector<TableRow> match_each(const SweepSetup& setup, const SampleBlock& block) {
  const SourcePictures pictures(setup, block);
  std::vector<TableRow> rows;
  std::vector<std::size_t> minima;
  for (const std::size_t index : block.samples) {
    const SamplePoint& sample = setup.options.samples[index];
    auto picture = pictures.at(sample.specular);
    if (sample.specular == 0.0 || *std::max_element(picture.begin(), picture.end()) <= 0.0f) {
      rows.push_back(flat_row(sample, setup.target));
      continue;
    }
    auto weights = setup.picture_taker.weights(picture);
    if (setup.bank == nullptr) {
      rows.push_back(searched_row(setup, sample, std::move(picture), std::move(weights)));
      continue;
    }
    Matcher matcher(*setup.bank, {std::move(picture)}, std::move(weights));
    rows.push_back(matched_row(sample, matcher.match({1.0}, &minima)));
  }
  return rows;
}

// Matches all samples at once. Pictures of an affine source are combinations of two. If the weights do not
// depend on specular either (uniform, or relative to a picture that only scales), one set of inner products
// serves all.
std::vector<TableRow> match_together(const SweepSetup& setup, const SampleBlock& block) {
  AffinePictures pictures = take_affine(setup.picture_taker, setup.source, block.alpha);
  auto weights = setup.picture_taker.weights(pictures.full);
  const bool proportional = setup.source.response.proportional();
  std::vector<std::vector<float>> basis;
  basis.push_back(std::move(pictures.slope));
  if (!proportional) basis.push_back(std::move(pictures.base));
  Matcher matcher(*setup.bank, std::move(basis), std::move(weights));

  const double most = setup.source.linear_range().max;
  const bool is_dark = *std::max_element(pictures.full.begin(), pictures.full.end()) <= 0.0f;
  std::vector<TableRow> rows;
  for (const std::size_t index : block.samples) {
    const SamplePoint& sample = setup.options.samples[index];
    std::vector<std::size_t> minima;  // products are shared, so each material can search the whole bank
    std::vector<double> coefficients = {std::min(sample.specular, most)};
    if (!proportional) coefficients.push_back(1.0);
    rows.push_back(is_dark || sample.specular == 0.0
                       ? flat_row(sample, setup.target)
                       : matched_row(sample, matcher.match(coefficients, &minima)));
  }
  return rows;
}

// Matches specular and width, from pictures without diffuse.
std::vector<TableRow> match_specular(const SweepSetup& setup, const SampleBlock& block) {
  const bool uniform = setup.options.objective.weighting == Weighting::kUniform;
  const SpecularResponse& source = setup.source.response;
  const bool shared = setup.bank != nullptr && (source.proportional() || (source.affine() && uniform));
  return shared ? match_together(setup, block) : match_each(setup, block);
}

// Matches diffuse by itself, in proportion.
void match_diffuse_apart(const SweepSetup& setup, TableRow* row) {
  const Range range = setup.target.diffuse_range();
  const double wanted = setup.options.diffuse * setup.diffuse.scale;
  row->diffuse1 = setup.options.diffuse;
  row->diffuse2 = std::clamp(wanted, range.min, range.max);
  if (row->diffuse2 != wanted && row->status == RowStatus::kOk) row->status = RowStatus::kClamped;
}

// Compares the whole picture, diffuse and specular: its error after two stages, the joint match after one or
// three.
void match_whole(const SweepSetup& setup, TableRow* row) {
  const RoleValues whole{row->alpha1, row->specular1, row->diffuse1};
  if (row->status == RowStatus::kFlat) return;
  auto picture = setup.picture_taker.take(setup.source, whole);
  if (*std::max_element(picture.begin(), picture.end()) <= 0.0f) {
    row->status = RowStatus::kFlat;
    return;
  }
  auto weights = setup.picture_taker.weights(picture);
  const JointMatcher matcher(*setup.pictures, std::move(picture), std::move(weights),
                             {true, row->diffuse1 > 0.0 || !setup.source.model.has(ParameterRole::kDiffuse)});
  const RoleValues apart{row->alpha2, row->specular2, row->diffuse2};
  if (setup.options.stages == 2) {
    row->error = matcher.error_of(setup.picture_taker.take(setup.target, apart));
    return;
  }
  const JointMatch match =
      matcher.match_from(setup.options.stages == 1 ? matcher.point_of(kFixedGuess) : apart);
  row->alpha2 = match.point().alpha;
  row->specular2 = match.point().specular;
  row->diffuse2 = match.point().diffuse;
  row->error = match.error;
  row->status = match.status;
}

// Rows before a one-stage match, without target values.
std::vector<TableRow> unmatched_rows(const SweepSetup& setup, const SampleBlock& block) {
  std::vector<TableRow> rows;
  for (const std::size_t index : block.samples) {
    const SamplePoint& sample = setup.options.samples[index];
    rows.push_back(flat_row(sample, setup.target));
    if (sample.specular != 0.0) rows.back().status = RowStatus::kOk;
  }
  return rows;
}

}  // namespace

bool has_diffuse(const SweepOptions& options) { return options.stages != 2 || options.diffuse > 0.0; }

std::vector<TableRow> match_block(const SweepSetup& setup, const SampleBlock& block) {
  std::vector<TableRow> rows =
      setup.options.stages == 1 ? unmatched_rows(setup, block) : match_specular(setup, block);
  for (TableRow& row : rows) {
    if (has_diffuse(setup.options)) {
      match_diffuse_apart(setup, &row);
      match_whole(setup, &row);
    }
    const bool held = !setup.source_widths.effective.contains(row.alpha1);
    if (held && row.status == RowStatus::kOk) row.status = RowStatus::kClamped;
  }
  return rows;
}

}  // namespace remapc
