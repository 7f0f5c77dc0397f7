#include "converter/converter_fields.hpp"

#include <cmath>
#include <cstdint>

#include "remap/error.hpp"

namespace remap {

void require_fit_file(const Field& root) {
  if (root["format"].text() != "remap-fit") root.fail("not a fit file (\"format\" must be \"remap-fit\")");
  const std::int64_t version = root["version"].count();
  if (version != kFitFormatVersion)
    root.fail("has format version " + std::to_string(version) + ", but this program reads version " +
              std::to_string(kFitFormatVersion) +
              (version < kFitFormatVersion ? " (make it again by remapc fit or remapc warp)"
                                           : " (use the newer remap that wrote it)"));
}

bool is_of_materials(const Field& root) {
  return root.contains("source") && root["source"].contains("workflow");
}

Range read_range(const Field& field) {
  const Range range{field.at(0, 2).number(), field.at(1, 2).number()};
  field.require(range.min < range.max, "[min, max] with min < max");
  return range;
}

ModelSide read_side(const Field& field) {
  const RoughnessEncoding convention =
      field["roughness"].named(kRoughnessEncodings, "alpha, roughness, exponent, glossiness or squared");
  const std::string specular = field["specular"].text();
  field["specular"].require(is_valid_specular(specular), "an identifier that names no width");
  return {read_model(field["model"]), convention, specular};
}

std::string read_id(const Field& field) {
  const std::string id = field.text();
  field.require(is_valid_id(id), kIdRule);
  return id;
}

std::string read_model(const Field& field) {
  const std::string model = field.text();
  field.require(is_valid_model(model),
                "letters, digits and _ - . /, at most " + std::to_string(kLongestName));
  return model;
}

std::string read_tool_version(const Field& field) {
  const std::string tool = field.text();
  field.require(tool.starts_with("remapc "), "remapc and its version");
  return tool.substr(7);
}

double finite(double value) {
  if (!std::isfinite(value))
    throw Error(ErrorKind::kNumeric, "fit: a number is not finite; a fit file holds finite numbers only");
  return value;
}

Json side_json(const ModelSide& side) {
  return {{"model", side.model},
          {"roughness", std::string(encoding_name(side.roughness))},
          {"specular", side.specular}};
}

Json domain_json(const ConverterInfo& info) {
  return {{"roughness", {info.roughness.min, info.roughness.max}},
          {"specular", {info.specular.min, info.specular.max}}};
}

Json errors_json(const ConverterInfo& info) {
  const auto json = [](const std::optional<double>& error) { return error ? Json(*error) : Json(); };
  return {{"roughness", json(info.roughness_rms_error)},
          {"specular", json(info.specular_rms_error)},
          {"image", json(info.image_rms_error)}};
}

Json ssim_json(const ConverterInfo& info) { return info.ssim ? Json(*info.ssim) : Json(); }

}  // namespace remap
