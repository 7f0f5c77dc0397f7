#include "fit/inverse_table.hpp"

#include <algorithm>
#include <limits>

#include "lower/chain.hpp"
#include "lower/interpreter.hpp"
#include "remap/version.hpp"

namespace remap {
namespace {

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

Table inverse_table(const Fit& fit, std::string_view bytes, std::size_t alpha_count,
                    std::size_t specular_count) {
  Table table;
  table.source = fit.target;
  table.target = fit.source;
  table.name = converter_id(table.source.model, table.target.model) + ".csv";
  const double least = fit.domain.specular.max / static_cast<double>(specular_count);
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
  for (std::size_t i = 0; i < alpha_count; ++i)
    for (std::size_t j = 1; j <= specular_count; ++j) {
      const double share = static_cast<double>(i) / static_cast<double>(alpha_count - 1);
      const double alpha = i + 1 == alpha_count ? alphas.max : alphas.min + share * (alphas.max - alphas.min);
      table.rows.push_back(
          row_of(fit, {alpha, top * static_cast<double>(j) / static_cast<double>(specular_count)}));
    }
  return table;
}

}  // namespace remap
