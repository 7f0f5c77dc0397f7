#include "fit/fit_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <openssl/evp.h>

#include "error.hpp"
#include "fit/comparison.hpp"
#include "fit/split.hpp"
#include "model/interpreter.hpp"
#include "number_text.hpp"
#include "table/check.hpp"
#include "table/domain.hpp"
#include "version.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

void require_models(const Table& table) {
  if (table.source.model.empty() || table.target.model.empty())
    throw Error(ErrorKind::kInput,
                table.name +
                    ": does not say which models it converts; expected `# source: ...` and "
                    "`# target: ...` lines, or --source and --target");
  for (const remap::ModelSide& side : {table.source, table.target}) {
    if (!remap::is_valid_model(side.model))
      throw Error(ErrorKind::kInput,
                  table.name + ": model \"" + side.model + "\"; expected letters, digits and _ - . / only");
    if (!remap::is_valid_specular(side.specular))
      throw Error(ErrorKind::kInput, table.name + ": specular parameter \"" + side.specular + "\" of " +
                                         side.model + "; expected an identifier that names no width");
  }
}

// The pairs of numbers of kSpheresComment; those that are none are left out.
std::vector<remap::SphereSimilarity> spheres_of(const Table& table) {
  std::vector<remap::SphereSimilarity> spheres;
  for (const auto& [key, value] : table.comments) {
    if (key != kSpheresComment) continue;
    std::istringstream pairs(value);
    for (std::string pair; std::getline(pairs >> std::ws, pair, ',');) {
      const std::size_t space = pair.find(' ');
      const auto alpha = remap::parse_number(pair.substr(0, space));
      const auto ssim =
          space == std::string::npos ? std::nullopt : remap::parse_number(pair.substr(space + 1));
      if (alpha && ssim) spheres.push_back({*alpha, *ssim});
    }
  }
  return spheres;
}

// How alike the pictures are at the best parameters over `rows`; none where the table does not say.
std::optional<remap::Likeness> likeness(const Table& table, const std::vector<TableRow>& rows) {
  std::vector<double> errors;
  for (const TableRow& row : rows)
    if (!std::isnan(row.error)) errors.push_back(row.error);
  if (errors.empty() || errors.size() != rows.size()) return std::nullopt;
  return remap::Likeness{error_figures(std::move(errors)), spheres_of(table)};
}

}  // namespace

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw Error(ErrorKind::kNumeric, "sha256: the digest could not be computed");
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (unsigned i = 0; i < length; ++i) {
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 15];
  }
  return text;
}

remap::TableRecord table_record(const std::filesystem::path& path, std::string_view bytes,
                                const std::vector<std::pair<std::string, std::string>>& comments) {
  remap::TableRecord record{path.filename().string(), sha256(bytes), {}};
  for (const auto& [key, value] : comments) record.comments[key] = value;
  return record;
}

std::string fit_id(const std::string& id, const std::string& source_model, const std::string& target_model) {
  const std::string chosen = id.empty() ? remap::converter_id(source_model, target_model) : id;
  if (!remap::is_valid_id(chosen))
    throw Error(ErrorKind::kUsage,
                "id: \"" + chosen + "\"; expected a C++ identifier without leading or doubled underscore");
  return chosen;
}

RowErrors row_errors(const remap::Fit& fit, const std::vector<TableRow>& rows) {
  std::vector<double> alpha_errors, specular_errors;
  for (const TableRow& row : rows) {
    const remap::MappedTexel texel = remap::evaluate_mapping(fit.mapping, row.alpha1, row.specular1);
    alpha_errors.push_back(texel.alpha - row.alpha2);
    specular_errors.push_back(texel.specular - row.specular2);
  }
  return {error_figures(std::move(alpha_errors)), error_figures(std::move(specular_errors))};
}

FittedTable fit_table(const Table& table, std::string_view bytes, const FitOptions& options,
                      const FitProgress& progress) {
  require_models(table);
  require_fittable(table);
  remap::Fit fit;
  fit.id = fit_id(options.id, table.source.model, table.target.model);
  fit.source = table.source;
  fit.target = table.target;
  fit.domain = table_domain(table);
  fit.table = table_record(table.name, bytes, table.comments);
  fit.likeness = likeness(table, rows_inside(usable_rows(table), fit.domain));
  fit.tool_version = remap::kVersion;

  const RowSplit split = split_rows(table, fit.domain, options.regression.seed, options.held_out_fraction);
  fit.split = split.record;
  const auto fit_of = [&](const Regression& regression) {
    remap::Fit one = fit;
    one.mapping = regression.mapping;
    one.method = regression.method;
    const RowErrors errors = row_errors(one, split.held_out);
    one.roughness_error = errors.alpha;
    one.specular_error = errors.specular;
    return one;
  };
  if (options.regressor)
    return {fit_of(regress(*options.regressor, split.training, fit.domain, options.regression, progress)),
            {}};
  const Comparison comparison =
      compare_regressions(split.training, fit.domain, {options.regression, 5, 2}, progress);
  for (const Contender& contender : comparison.contenders) fit.candidates.push_back(contender.candidate);
  FittedTable fitted{fit_of(comparison.contenders[comparison.chosen].regression), {}};
  for (const Contender& contender : comparison.contenders)
    if (contender.fitted) fitted.compared.push_back(fit_of(contender.regression));
  return fitted;
}

}  // namespace remapc
