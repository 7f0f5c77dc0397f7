#include "fit/fit_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <sstream>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "fit/parametric/parametric.hpp"
#include "fit/svr/svr.hpp"
#include "lower/chain.hpp"
#include "lower/interpreter.hpp"
#include "remap/version.hpp"
#include "table/check.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

void require_models(const Table& table) {
  if (table.source.model.empty() || table.target.model.empty())
    throw input_error(table.name +
                      ": does not state its models (add `# source: ...` and `# target: ...` lines, or use "
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

// Nobody sees specular below this fraction of the largest. There, learned fits make the output proportional
// to the input.
constexpr double kLeastShare = 0.02;

// Parses the pairs of numbers in kSpheresComment, and skips invalid pairs.
std::map<double, double> spheres_of(const Table& table) {
  std::map<double, double> spheres;
  for (const auto& [key, value] : table.comments) {
    if (key != kSpheresComment) continue;
    std::istringstream pairs(value);
    for (std::string pair; std::getline(pairs >> std::ws, pair, ',');) {
      const std::size_t space = pair.find(' ');
      const auto alpha = parse_number(pair.substr(0, space));
      const auto ssim = space == std::string::npos ? std::nullopt : parse_number(pair.substr(space + 1));
      if (alpha && ssim) spheres.emplace(*alpha, *ssim);
    }
  }
  return spheres;
}

// Returns the errors of pictures at the best parameters, if all `rows` have them.
std::optional<ErrorFigures> image_error(const std::vector<TableRow>& rows) {
  std::vector<double> errors;
  for (const TableRow& row : rows)
    if (!std::isnan(row.error)) errors.push_back(row.error);
  if (errors.empty() || errors.size() != rows.size()) return std::nullopt;
  return error_figures(std::move(errors));
}

constexpr std::size_t kInverseAlphas = 48, kInverseSpeculars = 10;
constexpr int kProbes = 400;  // alphas at which the largest specular is computed

// Returns the largest target specular that the fit reaches at every alpha. This is where the inverse ends.
double reached_specular(const Fit& fit) {
  double least = std::numeric_limits<double>::infinity();
  const Range& alphas = fit.domain.alpha;
  for (int i = 0; i <= kProbes; ++i) {
    const double alpha = alphas.min + (alphas.max - alphas.min) * i / kProbes;
    least = std::min(least, evaluate_fit(fit, alpha, fit.domain.specular.max).specular);
  }
  return least;
}

TableRow row_of(const Fit& fit, const MappedTexel& target) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  if (const auto source = inverse(fit, target))
    return {target.alpha, target.specular, source->alpha, source->specular, unknown, RowStatus::kOk, 0};
  const double alpha = std::clamp(target.alpha, fit.domain.alpha.min, fit.domain.alpha.max);
  const double black = evaluate_fit(fit, alpha, 0.0).specular;
  const RowStatus status = target.specular <= black ? RowStatus::kFlat : RowStatus::kClamped;
  return {target.alpha, target.specular, alpha, fit.domain.specular.max, unknown, status, 0};
}

}  // namespace

Fit fit_table(const Table& table, std::string_view bytes, const FitOptions& options,
              const FitProgress& progress, std::vector<Fit>* compared) {
  require_models(table);
  require_fittable(table, options.accept_light);
  Fit fit;
  fit.id = fit_id(options.id, table.source.model, table.target.model);
  fit.source = table.source;
  fit.target = table.target;
  fit.domain = table_domain(table);
  fit.table = table_record(table.name, bytes, table.comments);
  fit.tool_version = kVersion;

  const RowSplit split = split_rows(table, fit.domain, options.seed, options.held_out_fraction);
  fit.split = split.record;
  std::vector<TableRow> answers = split.training;
  answers.insert(answers.end(), split.held_out.begin(), split.held_out.end());
  fit.image_error = image_error(answers);
  if (fit.image_error) fit.ssim = spheres_of(table);
  fit.limits = table.limits;
  // If the fit is an inverse, similar pictures do not suffice. It must return the parameters of the source.
  const bool is_inverse = fit.table.comments.contains("inverse_of");
  const std::unique_ptr<PairPictures> pictures =
      is_inverse ? nullptr : pair_pictures(fit.source.model, fit.target.model, fit.domain, options.jobs);
  if (!options.kind.empty()) {
    std::vector<TableRow> below_limits = split.training;
    std::erase_if(below_limits, [](const TableRow& row) { return row.status != RowStatus::kOk; });
    const Regression regression = fit_kind(below_limits, fit.domain, options, progress);
    fit.mapping = regression.mapping;
    fit.method = regression.method;
    if (!is_proportional(fit.mapping)) fit.domain.specular.min = kLeastShare * fit.domain.specular.max;
    judge_fit(split, pictures.get(), &fit);
    return fit;
  }
  return compare_forms(fit, split, pictures.get(), progress, compared);
}

Regression fit_kind(const std::vector<TableRow>& rows, const Domain& domain, const FitOptions& options,
                    const FitProgress& progress) {
  if (options.kind == "parametric") return fit_parametric(rows, domain, options.form);
  if (options.kind == "svr") return fit_svr(rows, {options.seed, options.jobs, {}, {}}, progress);
  if (options.kind != "mlp") throw usage_error("unknown kind of fit '" + std::string(options.kind) + "'");
  TrainingOptions mlp = options.mlp;
  mlp.seed = options.seed;
  mlp.jobs = options.jobs;
  return fit_mlp(rows, mlp, progress);
}

Table inverse_table(const Fit& fit, std::string_view bytes) {
  Table table;
  table.source = fit.target;
  table.target = fit.source;
  table.name = converter_id(table.source.model, table.target.model) + ".csv";
  const double least = fit.domain.specular.max / kInverseSpeculars;
  const Range alphas{evaluate_fit(fit, fit.domain.alpha.min, least).alpha,
                     evaluate_fit(fit, fit.domain.alpha.max, least).alpha};
  const double top = reached_specular(fit);
  table.comments = {
      {"tool", std::string("remapc ") + kVersion},
      {"source", table.source.model},
      {"source_roughness", std::string(encoding_name(table.source.roughness))},
      {"source_specular", table.source.specular},
      {"target", table.target.model},
      {"target_roughness", std::string(encoding_name(table.target.roughness))},
      {"target_specular", table.target.specular},
      {"inverse_of", fit.id},
      {"inverse_of_sha256", sha256(bytes)},
  };
  for (std::size_t i = 0; i < kInverseAlphas; ++i)
    for (std::size_t j = 1; j <= kInverseSpeculars; ++j) {
      const double share = static_cast<double>(i) / (kInverseAlphas - 1.0);
      const double alpha =
          i + 1 == kInverseAlphas ? alphas.max : alphas.min + share * (alphas.max - alphas.min);
      table.rows.push_back(row_of(fit, {alpha, top * static_cast<double>(j) / kInverseSpeculars}));
    }
  return table;
}

}  // namespace remap
