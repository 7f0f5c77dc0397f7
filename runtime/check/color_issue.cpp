#include "check/color_issue.hpp"

#include <algorithm>

#include "core/report_text.hpp"

namespace remap {
namespace {

using Rows = std::vector<std::vector<float>>;

// Returns the largest channel of each texel.
std::vector<float> largest_of(const Rows& rows) {
  std::vector<float> largest = rows.front();
  for (const std::vector<float>& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) largest[i] = std::max(largest[i], row[i]);
  return largest;
}

double share_within(const std::vector<float>& values, float low, float high) {
  const auto inside =
      std::count_if(values.begin(), values.end(), [&](float v) { return v >= low && v <= high; });
  return static_cast<double>(inside) / static_cast<double>(values.size());
}

bool all_are(const Rows& rows, float value) {
  return std::ranges::all_of(
      rows, [&](const auto& row) { return std::ranges::all_of(row, [&](float v) { return v == value; }); });
}

// Most materials are dielectrics with an F0 of 0.03 to 0.05. In the wrong color space, this becomes 0.19 to
// 0.25, which only a few gems have, or 0.002 to 0.004, which no material has.
std::optional<ColorIssue> transfer_issue(Transfer transfer, const Rows& linear) {
  constexpr double kMuch = 0.4, kLittle = 0.05;
  const std::vector<float> values = largest_of(linear);
  if (share_within(values, 0.027f, 0.055f) > kLittle) return std::nullopt;
  const bool is_srgb = transfer == Transfer::kSrgb;
  const double share = is_srgb ? share_within(values, 0.0018f, 0.0045f) : share_within(values, 0.185f, 0.26f);
  if (share < kMuch) return std::nullopt;
  return ColorIssue{std::string("is ") + (is_srgb ? "0.002 to 0.0045" : "0.19 to 0.26") + " in " +
                        fixed(100.0 * share, 0) + " % of the texels, like F0 0.04 stored " +
                        (is_srgb ? "linear" : "in sRGB"),
                    is_srgb ? Transfer::kLinear : Transfer::kSrgb};
}

// Finds the same issues as color_issue(). The text does not name the transfer curve yet.
std::optional<ColorIssue> issue_of(Role role, Transfer transfer, const Rows& linear) {
  const bool is_specular = role == Role::kSpecular;
  if (!is_specular && role != Role::kDiffuse && role != Role::kBaseColor) return std::nullopt;
  if (linear.empty() || linear.front().empty()) return std::nullopt;
  if (all_are(linear, 0.0f) && role != Role::kDiffuse)
    return ColorIssue{std::string("is black everywhere (") +
                          (is_specular ? "dielectrics have a linear F0 of 0.04)" : "a color is needed)"),
                      {}};
  if (all_are(linear, 1.0f))
    return ColorIssue{
        std::string("is white everywhere (") +
            (is_specular ? "F0 is needed, not a specular strength)" : "a reflectance below 1 is needed)"),
        {}};
  return is_specular ? transfer_issue(transfer, linear) : std::nullopt;
}

}  // namespace

std::optional<ColorIssue> color_issue(Role role, Transfer transfer, const Rows& linear) {
  std::optional<ColorIssue> issue = issue_of(role, transfer, linear);
  if (issue) issue->text = "read as " + std::string(name_of(kTransfers, transfer)) + ", " + issue->text;
  return issue;
}

}  // namespace remap
