// This file describes a converter of width and specular.
#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "emit/header_data.hpp"
#include "remap/converter.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// Returns words for a comment in the header.
const char* meaning_of(RoughnessEncoding encoding) {
  switch (encoding) {
    case RoughnessEncoding::kAlpha:
      break;
    case RoughnessEncoding::kRoughness:
      return "perceptual roughness, square root of the microfacet width, (0, 1]";
    case RoughnessEncoding::kExponent:
      return "Phong exponent, 2 / alpha^2 - 2 of the microfacet width, from 0";
    case RoughnessEncoding::kGlossiness:
      return "1 - square root of the microfacet width, [0, 1)";
    case RoughnessEncoding::kSquared:
      return "square of the microfacet width, (0, 1]";
  }
  return "microfacet width, (0, 1]";
}

std::string error_text(const std::string& name, const ErrorFigures& figures) {
  return name + " rms " + two_digits(figures.rms) + ", 99 % " + two_digits(figures.p99) + ", max " +
         two_digits(figures.max);
}

std::string range_text(const std::string& name, const Range& range) {
  return name + " " + number_text(range.min) + " to " + number_text(range.max);
}

// Returns how much pictures differ, and where the numbers come from, for readers who do not know remap.
std::string provenance(const Fit& fit) {
  const auto comment = [&](const std::string& key) {
    const auto found = fit.table.comments.find(key);
    return found == fit.table.comments.end() ? std::string() : found->second;
  };
  std::string text;
  for (const std::string& remark : fit.remarks) text += remark + "\n";
  if (fit.pictures)
    text += "Pictures of spheres differ by " + fixed(fit.pictures->rmse, 1) +
            " % of white on average (root mean square of display values), by " +
            fixed(fit.copied_pictures->rmse, 1) +
            " %\nwhere the numbers are copied: lights and materials that had no "
            "part in the fit.\n";
  if (!fit.table.name.empty()) text += "Table " + fit.table.name + ", sha256 " + fit.table.sha256 + ";\n";
  if (!comment("objective").empty())
    text += "objective " + comment("objective") + " (lights " + comment("lights") + ", weighting " +
            comment("weighting") + "), " + comment("resolution") + " pixels squared, by " +
            comment("renderer") + ".\n";
  text += "Fit: " + kind_name(fit.mapping) + ", " + std::to_string(number_count(fit.converter->form)) +
          " numbers";
  if (fit.split.trained_rows + fit.split.held_out_rows != 0)
    text += ", seed " + std::to_string(fit.split.seed) + ", " + std::to_string(fit.split.trained_rows) +
            " rows trained, " + std::to_string(fit.split.held_out_rows) + " held out";
  text += ".\n";
  if (fit.has_errors())
    text += std::string("Error ") +
            (fit.split.held_out_rows != 0 ? "on the rows held out: " : "of its steps together: ") +
            error_text("alpha", fit.alpha_error) + ";\n" +
            error_text(fit.target.specular, fit.specular_error) + ".\n";
  else
    text += "Its error is not known.\n";
  return text + "The code is within " + two_digits(fit.converter->alpha_bound) + " of the fit in alpha and " +
         two_digits(fit.converter->specular_bound) + " in specular (proven).\nCovers " +
         range_text("alpha", fit.domain.alpha) + ", " + range_text(fit.source.specular, fit.domain.specular) +
         ".";
}

HeaderEnd end_of(const ModelSide& side) {
  return {
      side.model,
      std::string(encoding_name(side.roughness)),
      {{"width", 1, meaning_of(side.roughness)},
       {"specular", 1,
        side.specular == "f0" ? "reflectance at normal incidence, linear" : "specular reflectance, linear"}}};
}

}  // namespace

std::string two_digits(double error) { return number_text(rounded_up(error, 2)); }

const ConverterData& require_converter(const Fit& fit) {
  if (fit.converter) return *fit.converter;
  throw Error(ErrorKind::kNumeric,
              fit.id + ": has no converter, because it could not be lowered (remapc fit --lower)");
}

HeaderData describe(const Fit& fit) {
  const ConverterData& converter = require_converter(fit);
  HeaderData data;
  data.id = fit.id;
  data.title = fit.source.model + " to " + fit.target.model +
               ": which parameters of the second give the same picture as those of the first.";
  data.provenance = provenance(fit);
  data.source = end_of(fit.source);
  data.target = end_of(fit.target);
  for (const GoldenTexel& g : converter.golden)
    data.golden.push_back(
        {{g.width, g.specular}, {g.width_out, g.specular_out}, {g.width_within, g.specular_within}});
  data.code = converter;
  return data;
}

}  // namespace remap
