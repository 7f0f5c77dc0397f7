#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "remap/warp.hpp"

namespace remap {
namespace {

// A NodePosition is a position between two neighbours of `count` evenly spaced nodes.
struct NodePosition {
  std::size_t first = 0;
  double fraction = 0.0;
};

NodePosition position_of(double place, std::size_t count) noexcept {
  const double clamped = std::clamp(place, 0.0, static_cast<double>(count - 1));
  const std::size_t first = std::min(static_cast<std::size_t>(clamped), count - 2);
  return {first, clamped - static_cast<double>(first)};
}

// Returns the position of an alpha between the least alpha (0) and the largest alpha (1).
double width_share(const AppearanceCoordinates& space, float alpha) noexcept {
  const double least = static_cast<double>(space.least_alpha);
  const double clamped = static_cast<double>(std::clamp(alpha, space.least_alpha, space.largest_alpha));
  return std::log(clamped / least) / std::log(static_cast<double>(space.largest_alpha) / least);
}

double clamped_reflectance(float value) noexcept { return std::clamp(static_cast<double>(value), 0.0, 1.0); }

bool has_nan(const WarpTexel& texel) noexcept {
  return std::ranges::any_of(texel, [](float value) { return std::isnan(value); });
}

bool all_finite(const std::vector<float>& values) {
  return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

std::size_t power(std::size_t base, std::size_t exponent) noexcept {
  std::size_t result = 1;
  for (std::size_t i = 0; i < exponent; ++i) result *= base;
  return result;
}

void require(bool holds, const std::string& context, const char* found_and_expected) {
  if (!holds) throw input_error(context + ": " + found_and_expected);
}

using Position = std::array<double, kLargestWarpDimension>;

Position position_by(const AppearanceCoordinates& space, const SeparableTerms& terms,
                     const WarpTexel& texel) noexcept {
  const std::size_t n = space.dimension, nodes = width_node_count(space, terms);
  const NodePosition node = position_of(width_share(space, texel[6]) * static_cast<double>(nodes - 1), nodes);
  const float* specular = terms.specular.data() + node.first * n * 3;
  const float* offset = terms.offset.data() + node.first * n;
  const auto between = [&](const float* value, std::size_t stride) {
    const double first = static_cast<double>(value[0]), second = static_cast<double>(value[stride]);
    return first + node.fraction * (second - first);
  };
  Position position{};
  for (std::size_t k = 0; k < n; ++k) {
    position[k] = between(offset + k, n);
    for (std::size_t c = 0; c < 3; ++c)
      position[k] += clamped_reflectance(texel[c]) * static_cast<double>(terms.diffuse[3 * k + c]) +
                     clamped_reflectance(texel[3 + c]) * between(specular + 3 * k + c, 3 * n);
  }
  return position;
}

Position position_by(const AppearanceCoordinates& space, const QuadraticTerms& quadratic,
                     const WarpTexel& texel) noexcept {
  const auto terms = quadratic_terms(space, texel);
  Position position{};
  for (std::size_t k = 0; k < space.dimension; ++k)
    for (std::size_t t = 0; t < terms.size(); ++t)
      position[k] += static_cast<double>(quadratic.weights[k * kQuadraticTerms + t]) * terms[t];
  return position;
}

WarpTexel entry_at(const BlendedNodes& entries, std::size_t nodes, std::size_t dimension,
                   const Position& position) noexcept {
  std::array<NodePosition, kLargestWarpDimension> node{};
  for (std::size_t k = 0; k < dimension; ++k) node[k] = position_of(position[k], nodes);
  std::array<double, kWarpParameters> sum{};
  for (std::size_t corner = 0; corner < (std::size_t{1} << dimension); ++corner) {
    double weight = 1.0;
    std::size_t index = 0;
    for (std::size_t k = dimension; k-- > 0;) {
      const std::size_t upper = corner >> k & 1;
      weight *= upper != 0 ? node[k].fraction : 1.0 - node[k].fraction;
      index = index * nodes + node[k].first + upper;
    }
    for (std::size_t p = 0; p < kWarpParameters; ++p)
      sum[p] += weight * static_cast<double>(decoded(entries, p, entries.codes[index * kWarpParameters + p]));
  }
  WarpTexel result;
  for (std::size_t p = 0; p < kWarpParameters; ++p) result[p] = static_cast<float>(sum[p]);
  return result;
}

WarpTexel entry_at(const CopiedNodes& entries, std::size_t nodes, std::size_t dimension,
                   const Position& position) noexcept {
  std::size_t index = 0;
  for (std::size_t k = dimension; k-- > 0;)
    index = index * nodes + static_cast<std::size_t>(position[k] + 0.5);
  return entries.palette[entries.indices[index]];
}

std::size_t number_count(const SeparableTerms& terms) noexcept {
  return terms.diffuse.size() + terms.specular.size() + terms.offset.size();
}
std::size_t number_count(const QuadraticTerms& terms) noexcept { return terms.weights.size(); }

std::size_t entry_bytes(const BlendedNodes& entries) noexcept {
  return entries.codes.size() + 2 * kWarpParameters * sizeof(float);
}
std::size_t entry_bytes(const CopiedNodes& entries) noexcept {
  return entries.palette.size() * sizeof(WarpTexel) + entries.indices.size() * sizeof(std::uint16_t);
}

void require_entries(const BlendedNodes& entries, std::size_t count, const std::string& context) {
  require(entries.codes.size() == count * kWarpParameters, context,
          "the table has the wrong size (seven codes per node)");
  for (std::size_t p = 0; p < kWarpParameters; ++p)
    require(std::isfinite(entries.least[p]) && std::isfinite(entries.largest[p]) &&
                entries.least[p] <= entries.largest[p] && entries.least[p] >= 0.0f,
            context, "the range of a parameter is empty (both ends must be finite and 0 or more)");
}

void require_entries(const CopiedNodes& entries, std::size_t count, const std::string& context) {
  require(entries.indices.size() == count, context, "the table has the wrong size (one index per node)");
  require(!entries.palette.empty() && entries.palette.size() <= kLargestPalette, context,
          "the palette has the wrong size (1 to 65536 texels)");
  for (const WarpTexel& texel : entries.palette)
    for (const float value : texel)
      require(std::isfinite(value) && value >= 0.0f, context,
              "the palette contains an invalid value (all must be finite and 0 or more)");
  for (const std::uint16_t index : entries.indices)
    require(index < entries.palette.size(), context, "an index is beyond the end of the palette");
}

void require_terms(const AppearanceCoordinates& space, const SeparableTerms& terms,
                   const std::string& context) {
  const std::size_t n = space.dimension, nodes = width_node_count(space, terms);
  require(terms.diffuse.size() == 3 * n && all_finite(terms.diffuse), context,
          "the weights of diffuse are invalid (three finite numbers per dimension)");
  require(nodes >= 2 && terms.offset.size() == n * nodes && all_finite(terms.offset), context,
          "the offsets are invalid (a finite number per node and dimension, two nodes or more)");
  require(terms.specular.size() == 3 * terms.offset.size() && all_finite(terms.specular), context,
          "the weights of specular are invalid (three finite numbers per node and dimension)");
}

void require_terms(const AppearanceCoordinates& space, const QuadraticTerms& terms,
                   const std::string& context) {
  require(terms.weights.size() == space.dimension * kQuadraticTerms && all_finite(terms.weights), context,
          "the weights of quadratic terms are invalid (36 finite numbers per dimension)");
}

}  // namespace

std::array<double, kLargestWarpDimension> coordinates_of(const AppearanceCoordinates& space,
                                                         const WarpTexel& texel) noexcept {
  std::array<double, kLargestWarpDimension> position{};
  const std::size_t n = space.dimension;
  if (has_nan(texel)) {
    std::fill_n(position.begin(), n, std::numeric_limits<double>::quiet_NaN());
    return position;
  }
  std::visit([&](const auto& terms) { position = position_by(space, terms, texel); }, space.terms);
  return position;
}

std::size_t width_node_count(const AppearanceCoordinates& space, const SeparableTerms& terms) noexcept {
  return space.dimension == 0 ? 0 : terms.offset.size() / space.dimension;
}

std::array<double, kQuadraticTerms> quadratic_terms(const AppearanceCoordinates& space,
                                                    const WarpTexel& texel) noexcept {
  std::array<double, kWarpParameters> u{};
  for (std::size_t i = 0; i < 6; ++i) u[i] = std::cbrt(clamped_reflectance(texel[i]));
  u[6] = width_share(space, texel[6]);
  std::array<double, kQuadraticTerms> terms{};
  terms[0] = 1.0;
  std::ranges::copy(u, terms.begin() + 1);
  std::size_t next = 1 + u.size();
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t j = i; j < u.size(); ++j) terms[next++] = u[i] * u[j];
  return terms;
}

float decoded(const BlendedNodes& nodes, std::size_t parameter, std::uint8_t code) noexcept {
  const float share = static_cast<float>(code) / 255.0f;
  return nodes.least[parameter] + (nodes.largest[parameter] - nodes.least[parameter]) * (share * share);
}

std::array<double, kLargestWarpDimension> node_position_of(const CompiledWarp& warp,
                                                           const WarpTexel& texel) noexcept {
  const ParameterTable& table = warp.table;
  const double last = static_cast<double>(table.nodes - 1);
  auto position = coordinates_of(warp.coordinates, texel);
  for (std::size_t k = 0; k < warp.coordinates.dimension; ++k) {
    const double low = static_cast<double>(table.low[k]), high = static_cast<double>(table.high[k]);
    position[k] = std::clamp((position[k] - low) / (high - low) * last, 0.0, last);
  }
  return position;
}

WarpTexel evaluate_warp(const CompiledWarp& warp, const WarpTexel& texel) noexcept {
  if (has_nan(texel)) {
    WarpTexel result;
    result.fill(std::numeric_limits<float>::quiet_NaN());
    return result;
  }
  const Position position = node_position_of(warp, texel);
  return std::visit(
      [&](const auto& entries) {
        return entry_at(entries, warp.table.nodes, warp.coordinates.dimension, position);
      },
      warp.table.entries);
}

std::size_t byte_count(const CompiledWarp& warp) noexcept {
  const AppearanceCoordinates& space = warp.coordinates;
  const std::size_t terms = std::visit([](const auto& kind) { return number_count(kind); }, space.terms);
  const std::size_t entries =
      std::visit([](const auto& kind) { return entry_bytes(kind); }, warp.table.entries);
  return (terms + warp.table.low.size() + warp.table.high.size() + 2) * sizeof(float) + entries;
}

void require_valid(const CompiledWarp& warp, const std::string& context) {
  const AppearanceCoordinates& space = warp.coordinates;
  const ParameterTable& table = warp.table;
  const std::size_t n = space.dimension;
  require(n >= 1 && n <= kLargestWarpDimension, context, "the number of dimensions is invalid (1 to 3)");
  require(space.least_alpha > 0.0f && space.largest_alpha > space.least_alpha && space.largest_alpha <= 1.0f,
          context, "the range of alpha is invalid (it must lie within 0 and 1, and not be empty)");
  std::visit([&](const auto& terms) { require_terms(space, terms, context); }, space.terms);
  require(table.low.size() == n && table.high.size() == n && all_finite(table.low) && all_finite(table.high),
          context, "the box of coordinates is invalid (two finite corners)");
  for (std::size_t k = 0; k < n; ++k)
    require(table.low[k] < table.high[k], context,
            "the box of coordinates is empty (low must be below high)");
  require(table.nodes >= 2 && table.nodes <= 4096 && power(table.nodes, n) <= kMostNodes, context,
          "the number of nodes is invalid (2 to 4096 per dimension, at most 2^24 in all)");
  std::visit([&](const auto& entries) { require_entries(entries, power(table.nodes, n), context); },
             table.entries);
}

}  // namespace remap
