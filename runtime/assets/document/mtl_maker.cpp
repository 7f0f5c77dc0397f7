#include "assets/document/mtl_maker.hpp"

#include <cmath>
#include <string_view>

#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr double kNewScaleSince = 3.4;

// Detects Blender 2.7, which wrote 1000 / 510 for each step of its hardness, an integer from 1 to 511.
bool has_steps_of_hardness(const MtlDocument& document) {
  constexpr double kStep = 1000.0 / 510.0, kRounding = 1e-5;
  std::size_t exponents = 0;
  for (const MtlStatement& statement : document.statements()) {
    if (document.word(statement) != "ns") continue;
    const auto exponent = parse_number(document.rest(statement));
    if (!exponent || std::fabs(std::remainder(*exponent, kStep)) > kRounding) return false;
    ++exponents;
  }
  return exponents > 0;
}

MtlMaker blender_of(const MtlDocument& document, std::string_view version) {
  version = version.substr(0, version.find_first_not_of("0123456789."));
  const auto number = parse_number(version.substr(0, version.find('.', version.find('.') + 1)));
  if (number) return *number < kNewScaleSince ? MtlMaker::kBlender28 : MtlMaker::kBlender;
  return has_steps_of_hardness(document) ? MtlMaker::kText : MtlMaker::kBlender28;
}

}  // namespace

MtlMaker maker_of(const MtlDocument& document) {
  const std::size_t first =
      document.statements().empty() ? document.text().size() : document.statements().front().line.begin;
  const std::string_view header = document.text().substr(0, first);
  constexpr std::string_view kBlender = "# Blender ", kTitle = "MTL File";
  if (const std::size_t found = header.find(kBlender); found != std::string_view::npos) {
    std::string_view line = header.substr(found + kBlender.size());
    line = line.substr(0, line.find_first_of("\r\n"));
    if (const std::size_t title = line.find(kTitle); title != std::string_view::npos)
      return blender_of(document, line.substr(line.starts_with('v') ? 1 : 0, title));
  }
  for (const MtlStatement& statement : document.statements())
    if (document.word(statement) == "bsdf" && in_lower_case(document.rest(statement)) == "pbr")
      return MtlMaker::kNvdiffrec;
  return MtlMaker::kText;
}

double blender_scale(MtlMaker maker) { return maker == MtlMaker::kBlender28 ? 900.0 : 1000.0; }

std::string maker_warning(MtlMaker maker) {
  const auto blender = [maker] {
    return "was written by Blender: texremap reads roughness as 1 - sqrt(Ns / " +
           number_text(blender_scale(maker)) +
           "), metallic from Ka and illum, and ignores Kd if there is map_Kd (--from mtl reads "
           "the file by the MTL specification)";
  };
  switch (maker) {
    case MtlMaker::kText:
      return "";
    case MtlMaker::kBlender:
    case MtlMaker::kBlender28:
      return blender();
    case MtlMaker::kNvdiffrec:
      return "has the line bsdf pbr: texremap reads roughness and metallic from green and blue of Ks (--from "
             "mtl reads the file by the MTL specification)";
  }
  return "";
}

}  // namespace remap
