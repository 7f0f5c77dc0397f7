#include "fit/edge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/number_text.hpp"
#include "lower/interpreter.hpp"
#include "table/split.hpp"

namespace remap {
namespace {

constexpr std::size_t kOutermostShare = 30;
constexpr std::size_t kFewestAlphas = 6;
constexpr std::size_t kFewestSpeculars = 4;
constexpr int kAlphas = 33;
constexpr std::array<double, 3> kChannels = {0.1, 0.5, 1.0};

std::size_t outermost_count(std::size_t count) { return std::max<std::size_t>(1, count / kOutermostShare); }

// The value of a sorted set at a position.
double at(const std::set<double>& values, std::size_t position) {
  return *std::next(values.begin(), static_cast<std::ptrdiff_t>(position));
}

using Color = std::array<double, 3>;

// Maps a color channel by channel.
Color map_color(const MappingKind& mapping, double alpha, Color color) {
  for (double& channel : color) channel = evaluate_mapping(mapping, alpha, channel).specular;
  return color;
}

// Where the result is not finite or negative; empty if it is neither.
std::string fault_at(const MappingKind& mapping, double alpha, double specular) {
  const MappedTexel texel = evaluate_mapping(mapping, alpha, specular);
  const bool is_sound = texel.alpha > 0.0 && texel.specular >= 0.0 && std::isfinite(texel.alpha) &&
                        std::isfinite(texel.specular);
  if (is_sound) return "";
  return "alpha2 " + number_text(texel.alpha) + " and specular2 " + number_text(texel.specular) +
         " at alpha1 " + number_text(alpha) + ", specular1 " + number_text(specular);
}

double chroma_difference(const Color& a, const Color& b) {
  const double a_sum = a[0] + a[1] + a[2], b_sum = b[0] + b[1] + b[2];
  if (!(a_sum > 0.0) || !(b_sum > 0.0)) return 1.0;
  double largest = 0.0;
  for (std::size_t c = 0; c < a.size(); ++c)
    largest = std::max(largest, std::fabs(a[c] / a_sum - b[c] / b_sum));
  return largest;
}

}  // namespace

EdgeRows edge_rows(const std::vector<TableRow>& rows) {
  std::set<double> alphas, speculars;
  for (const TableRow& row : rows) {
    alphas.insert(row.alpha1);
    speculars.insert(row.specular1);
  }
  const std::size_t cut = outermost_count(alphas.size());
  if (alphas.size() < kFewestAlphas + 2 * cut) return {rows, {}};
  const double low = at(alphas, cut), high = at(alphas, alphas.size() - 1 - cut);
  const double bright = speculars.size() < kFewestSpeculars
                            ? *speculars.rbegin()
                            : at(speculars, speculars.size() - 1 - outermost_count(speculars.size()));
  EdgeRows edge;
  for (const TableRow& row : rows) {
    const bool inside = row.alpha1 >= low && row.alpha1 <= high && row.specular1 <= bright;
    (inside ? edge.inner : edge.outer).push_back(row);
  }
  return edge;
}

Domain covered_domain(const std::vector<TableRow>& rows) {
  Domain domain{{1e300, -1e300}, {0.0, 0.0}};
  for (const TableRow& row : rows) {
    domain.alpha.min = std::min(domain.alpha.min, row.alpha1);
    domain.alpha.max = std::max(domain.alpha.max, row.alpha1);
    domain.specular.max = std::max(domain.specular.max, row.specular1);
  }
  return domain;
}

EdgeErrors edge_errors(const MappingKind& mapping, const Domain& domain, const std::vector<TableRow>& rows) {
  const Residuals raw = residuals_of(rows, mapping);
  const Residuals ruled = residuals_of(rows, [&](double alpha, double specular) {
    const double scale = std::max(1.0, specular / domain.specular.max);
    const double clamped = std::clamp(alpha, domain.alpha.min, domain.alpha.max);
    const MappedTexel texel = evaluate_mapping(mapping, clamped, specular / scale);
    return MappedTexel{texel.alpha, scale * texel.specular};
  });
  return {error_figures(ruled.alpha).rms, error_figures(ruled.specular).rms, error_figures(raw.alpha).rms,
          error_figures(raw.specular).rms};
}

BeyondDomain look_beyond(const MappingKind& mapping, const Domain& domain) {
  BeyondDomain beyond;
  const double edge = domain.specular.max;
  for (int i = 0; i < kAlphas; ++i) {
    const double share = static_cast<double>(i) / (kAlphas - 1);
    const double alpha = domain.alpha.min + share * (domain.alpha.max - domain.alpha.min);
    for (const double second : kChannels) {
      for (const double third : kChannels) {
        const Color inside = {edge, second * edge, third * edge};
        const Color outside = {kBeyond * inside[0], kBeyond * inside[1], kBeyond * inside[2]};
        beyond.chroma_shift = std::max(
            beyond.chroma_shift,
            chroma_difference(map_color(mapping, alpha, inside), map_color(mapping, alpha, outside)));
      }
    }
    for (const double channel : kChannels)
      if (beyond.fault.empty()) beyond.fault = fault_at(mapping, alpha, channel * edge);
  }
  return beyond;
}

}  // namespace remap
