#include "table/light.hpp"

#include <cmath>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/report_text.hpp"

namespace remap {
namespace {

std::string change_text(double scale) {
  return percent(std::fabs(scale - 1.0)) + (scale > 1.0 ? " larger" : " smaller");
}

}  // namespace

bool is_wrong_light(const LightMatch& match) {
  return std::fabs(match.scale - 1.0) > kMostLightChange && !match.accepted;
}

std::string light_remark(const LightMatch& match) {
  const double change = std::fabs(match.scale - 1.0);
  if (!(change > kSaidLightChange || match.diffuse_error > kSaidLightChange)) return "";
  const std::string left = "the diffuse pictures differ by " + percent(match.diffuse_error);
  if (!(change > kSaidLightChange)) return left + " (this does not change specular)";
  std::string remark = "diffuse matches only if the light of the source is multiplied by " +
                       number_text(rounded(match.scale, 4)) + " (" + left +
                       " after that). Therefore, specular2 is " + change_text(match.scale) +
                       ", which is right only if the two renderers have different light";
  if (is_wrong_light(match))
    remark +=
        " (check the diffuse of both models; --no-irradiance-matching keeps the light unchanged, "
        "--accept-light continues anyway)";
  return remark;
}

void require_light(const LightMatch& match, const std::string& context) {
  if (is_wrong_light(match)) throw input_error(context + ": " + light_remark(match));
}

LightMatch light_match(const Comments& comments) {
  LightMatch match;
  for (const auto& [key, value] : comments) {
    const double number = parse_number(value).value_or(0.0);
    if (key == kLightScaleComment && number > 0.0) match.scale = number;
    if (key == kDiffuseErrorComment) match.diffuse_error = number;
    if (key == kLightAcceptedComment) match.accepted = value == "yes";
  }
  return match;
}

}  // namespace remap
