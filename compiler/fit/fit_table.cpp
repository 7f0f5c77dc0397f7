#include "fit/fit_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "fit/comparison.hpp"
#include "fit/edge.hpp"
#include "fit/regime_fit.hpp"
#include "lower/interpreter.hpp"
#include "remap/version.hpp"
#include "table/check.hpp"
#include "table/domain.hpp"
#include "table/split.hpp"

namespace remap {
namespace {

void require_models(const Table& table) {
  if (table.source.model.empty() || table.target.model.empty())
    throw input_error(table.name +
                      ": does not name its models (add `# source: ...` and `# target: ...` lines, or use "
                      "--source and --target)");
  for (const ModelSide& side : {table.source, table.target}) {
    if (!is_valid_model(side.model))
      throw input_error(table.name + ": invalid model name '" + side.model +
                        "' (use letters, digits and _ - . /)");
    if (!is_valid_specular(side.specular))
      throw input_error(table.name + ": invalid specular parameter '" + side.specular + "' of " + side.model +
                        " (use an identifier that is not a roughness name)");
  }
}

// Parses the pairs of numbers of kSpheresComment and skips invalid ones.
std::vector<SphereSimilarity> spheres_of(const Table& table) {
  std::vector<SphereSimilarity> spheres;
  for (const auto& [key, value] : table.comments) {
    if (key != kSpheresComment) continue;
    std::istringstream pairs(value);
    for (std::string pair; std::getline(pairs >> std::ws, pair, ',');) {
      const std::size_t space = pair.find(' ');
      const auto alpha = parse_number(pair.substr(0, space));
      const auto ssim = space == std::string::npos ? std::nullopt : parse_number(pair.substr(space + 1));
      if (alpha && ssim) spheres.push_back({*alpha, *ssim});
    }
  }
  return spheres;
}

// The similarity of the pictures at the best parameters over `rows`, if the table states it.
std::optional<ImageSimilarity> image_similarity(const Table& table, const std::vector<TableRow>& rows) {
  std::vector<double> errors;
  for (const TableRow& row : rows)
    if (!std::isnan(row.error)) errors.push_back(row.error);
  if (errors.empty() || errors.size() != rows.size()) return std::nullopt;
  return ImageSimilarity{error_figures(std::move(errors)), spheres_of(table)};
}

}  // namespace

RowErrors row_errors(const Fit& fit, const std::vector<TableRow>& rows) {
  Residuals residuals =
      residuals_of(rows, [&](double alpha, double specular) { return evaluate_fit(fit, alpha, specular); });
  return {error_figures(std::move(residuals.alpha)), error_figures(std::move(residuals.specular))};
}

FittedTable fit_table(const Table& table, std::string_view bytes, const FitOptions& options,
                      const FitProgress& progress) {
  require_models(table);
  require_fittable(table, options.accept_light);
  Fit fit;
  fit.id = fit_id(options.id, table.source.model, table.target.model);
  fit.source = table.source;
  fit.target = table.target;
  fit.domain = table_domain(table);
  fit.table = table_record(table.name, bytes, table.comments);
  fit.tool_version = kVersion;

  const RowSplit split = split_rows(table, fit.domain, options.regression.seed, options.held_out_fraction);
  fit.split = split.record;
  std::vector<TableRow> answers = split.training;
  answers.insert(answers.end(), split.held_out.begin(), split.held_out.end());
  fit.image_similarity = image_similarity(table, answers);
  const RegimeRows rows = regime_rows(split.training, answers);
  const Domain inside = covered_domain(rows.inside);
  const auto fit_of = [&](const Regression& regression) {
    Fit one = fit;
    one.mapping = regression.mapping;
    one.method = regression.method;
    one.regimes =
        fit_regimes(rows, table.limits, one.mapping, fit.domain, options.regression.seed, &one.method);
    const RowErrors errors = row_errors(one, split.held_out);
    one.alpha_error = errors.alpha;
    one.specular_error = errors.specular;
    return one;
  };
  if (!options.kind.empty())
    return {fit_of(fit_kind(options.kind).fit(rows.inside, inside, options.regression, progress)), {}};
  const Comparison comparison = compare_regressions(rows.inside, inside, options.regression, progress);
  for (const Candidate& candidate : comparison.candidates) fit.candidates.push_back(candidate.record);
  FittedTable fitted{fit_of(comparison.candidates[comparison.chosen].regression), {}};
  for (const Candidate& candidate : comparison.candidates)
    if (candidate.regression.again) fitted.compared.push_back(fit_of(candidate.regression));
  return fitted;
}

}  // namespace remap
